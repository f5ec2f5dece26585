#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

namespace metamer::service::test {

/// A metamerd with the fake worker, stderr in the file `log` of a folder, and one end of a socket
/// pair as its descriptor 3. It ends with this.
class Program {
 public:
  /// `environment`: NAME=VALUE, besides TMPDIR, which is the folder.
  explicit Program(const std::filesystem::path& folder, std::vector<std::string> options,
                   std::vector<std::string> environment = {});
  ~Program();
  Program(const Program&) = delete;
  Program& operator=(const Program&) = delete;

  /// What the daemon says on that; empty when it ends first.
  std::string ready();
  void hang_up();
  /// Page faults so far that needed no disk.
  long faults() const;
  void signal(int number);
  /// Its exit code, or the signal that ended it, negative.
  int wait();
  std::string log() const;
  /// Waits until the log has this text; false when it has not within 10 s.
  bool says(const std::string& text) const;

 private:
  std::filesystem::path log_;
  int pair_end_ = -1;
  pid_t pid_ = -1;
};

}  // namespace metamer::service::test
