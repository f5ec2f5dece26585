#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <string>

namespace metamer::service::test {

/// Where the fake worker waits, in a state's folder.
class Gate {
 public:
  explicit Gate(const std::filesystem::path& state) {
    const std::string path = (state / "gate").string();
    EXPECT_EQ(::mkfifo(path.c_str(), 0600), 0);
    fd_ = ::open(path.c_str(), O_RDWR | O_CLOEXEC);
  }
  ~Gate() { ::close(fd_); }
  Gate(const Gate&) = delete;
  Gate& operator=(const Gate&) = delete;
  void open() const { EXPECT_EQ(::write(fd_, "x", 1), 1); }

 private:
  int fd_ = -1;
};

}  // namespace metamer::service::test
