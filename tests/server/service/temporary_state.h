#pragma once

#include <cstdlib>
#include <filesystem>
#include <string>

#include "server/service/store/schema.h"

namespace metamer::service::test {

/// A folder for a daemon's state, removed at the end.
class TemporaryState {
 public:
  TemporaryState() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "metamer-state-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~TemporaryState() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryState(const TemporaryState&) = delete;
  TemporaryState& operator=(const TemporaryState&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path database() const { return path_ / database_name; }

 private:
  std::filesystem::path path_;
};

}  // namespace metamer::service::test
