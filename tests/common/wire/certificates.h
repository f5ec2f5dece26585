#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/wire/tls.h"

namespace metamer::wire::test {

/// Certificates by the program `openssl`, in a folder that is removed at the end: an authority
/// (ca.pem), and whom it signed.
class Certificates {
 public:
  Certificates() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "metamer-certificates-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    run("req -x509 -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -days 2 -subj /CN=authority "
        "-keyout ca.key -out ca.pem");
  }
  ~Certificates() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Certificates(const Certificates&) = delete;

  /// `alternatives` as openssl writes them: "DNS:localhost,IP:127.0.0.1".
  TlsIdentity sign(const std::string& name, const std::string& alternatives) {
    std::ofstream(folder_ / (name + ".ext")) << "subjectAltName=" << alternatives << '\n';
    run("req -newkey ec -pkeyopt ec_paramgen_curve:P-256 -nodes -subj /CN=" + name + " -keyout " +
        name + ".key -out " + name + ".req");
    run("x509 -req -in " + name +
        ".req -CA ca.pem -CAkey ca.key -CAcreateserial -days 2 -extfile " + name + ".ext -out " +
        name + ".pem");
    return {path(name + ".pem"), path(name + ".key")};
  }
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  std::filesystem::path authority() const { return path("ca.pem"); }
  /// As openssl says it: 64 hexadecimal digits in lower case.
  std::string fingerprint(const std::string& name) {
    run("x509 -in " + name + ".pem -noout -fingerprint -sha256 > " + name + ".sum");
    std::ifstream file(path(name + ".sum"));
    std::string line;
    std::getline(file, line);
    std::string digits;
    for (const char c : line.substr(line.find('=') + 1))
      if (c != ':') digits += static_cast<char>(std::tolower(c));
    return digits;
  }

 private:
  void run(const std::string& words) {
    const std::string command = "cd " + folder_.string() + " && openssl " + words + " 2>> log";
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
  }

  std::filesystem::path folder_;
};

}  // namespace metamer::wire::test
