#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>
#include <vector>

namespace metamer {

/// A folder of its own for each test, gone afterwards.
class ImageFile : public testing::Test {
 protected:
  ImageFile() {
    std::string name = (std::filesystem::temp_directory_path() / "metamer-image-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~ImageFile() override { std::filesystem::remove_all(folder_); }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
      names.push_back(entry.path().filename().string());
    }
    return names;
  }

  std::filesystem::path folder_;
};

}  // namespace metamer
