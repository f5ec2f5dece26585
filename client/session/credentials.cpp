#include "client/session/credentials.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <toml++/toml.h>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

namespace metamer::client {

namespace fs = std::filesystem;

namespace {

tl::unexpected<Problem> failed_with(const fs::path& file, const std::string& what) {
  return problem(file.string() + ": " + what);
}

Result<toml::table> read_servers(const fs::path& file) {
  struct stat status {};
  if (::stat(file.c_str(), &status) != 0) {
    if (errno == ENOENT || errno == ENOTDIR) return toml::table();
    return failed_with(file, std::strerror(errno));
  }
  if ((status.st_mode & (S_IRWXG | S_IRWXO)) != 0)
    return failed_with(file, "others may read the tokens in it; chmod 600 it");
  std::ifstream stream(file);
  try {
    return toml::parse(stream, file.string());
  } catch (const toml::parse_error& error) {
    std::ostringstream place;
    place << "line " << error.source().begin.line << ": " << error.description();
    return failed_with(file, place.str());
  }
}

/// A new file takes the old one's place once it is whole and on the disk.
Result<void> replace(const fs::path& file, const std::string& text) {
  std::error_code error;
  fs::create_directories(file.parent_path(), error);
  if (error) return failed_with(file.parent_path(), error.message());
  std::string name = file.string() + ".XXXXXX";
  const int fd = ::mkostemp(name.data(), O_CLOEXEC);  // of mode 0600
  if (fd < 0) return failed_with(file, std::strerror(errno));
  const bool written = ::write(fd, text.data(), text.size()) == static_cast<ssize_t>(text.size()) &&
                       ::fsync(fd) == 0;
  ::close(fd);
  if (written && ::rename(name.c_str(), file.c_str()) == 0) return {};
  const std::string why = std::strerror(errno);
  ::unlink(name.c_str());
  return failed_with(file, why);
}

}  // namespace

fs::path credentials_file() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  const char* home = std::getenv("HOME");
  const fs::path folder =
      config && *config ? fs::path(config) : fs::path(home ? home : "") / ".config";
  return folder / "metamer" / "servers.toml";
}

Result<Credentials> kept_credentials(const std::string& server) {
  const auto servers = read_servers(credentials_file());
  if (!servers) return tl::unexpected(servers.error());
  const toml::table* kept = (*servers)[server].as_table();
  Credentials credentials;
  if (!kept) return credentials;
  const auto text = [&](const char* key) { return (*kept)[key].value_or(std::string()); };
  credentials.token = text("token");
  credentials.authorities = text("ca");
  credentials.fingerprint = text("fingerprint");
  credentials.certificate = text("certificate");
  credentials.key = text("key");
  return credentials;
}

Result<void> keep_credentials(const std::string& server, const Credentials& credentials) {
  const fs::path file = credentials_file();
  auto servers = read_servers(file);
  if (!servers) return tl::unexpected(servers.error());
  toml::table kept;
  const auto put = [&](const char* key, const std::string& text) {
    if (!text.empty()) kept.insert_or_assign(key, text);
  };
  put("token", credentials.token);
  put("ca", credentials.authorities);
  put("fingerprint", credentials.fingerprint);
  put("certificate", credentials.certificate);
  put("key", credentials.key);
  servers->erase(server);
  if (!kept.empty()) servers->insert(server, std::move(kept));
  std::ostringstream text;
  text << "# What metamer login keeps. Whoever reads it is you to these servers.\n"
       << *servers << '\n';
  return replace(file, text.str());
}

}  // namespace metamer::client
