#include "server/service/ops/folders.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

namespace metamer::service {
namespace {

namespace fs = std::filesystem;

/// Lets the temporary folders of a test be made in one of its own.
class TemporaryFolders : public testing::Test {
 protected:
  TemporaryFolders() {
    if (const char* before = std::getenv("TMPDIR")) before_ = before;
    ::setenv("TMPDIR", base_.path().c_str(), 1);
  }
  ~TemporaryFolders() override {
    if (before_.empty()) {
      ::unsetenv("TMPDIR");
    } else {
      ::setenv("TMPDIR", before_.c_str(), 1);
    }
  }
  static void make_old(const fs::path& folder) {
    fs::last_write_time(folder, fs::file_time_type::clock::now() - std::chrono::minutes(5));
  }
  /// What a daemon that was killed leaves behind.
  fs::path orphan(const std::string& name) const {
    const fs::path folder = base_.path() / name;
    fs::create_directories(folder / "assets");
    std::ofstream(folder / "assets" / "one") << "bytes";
    make_old(folder);
    return folder;
  }

  TemporaryFolder base_ = TemporaryFolder::make().value();
  std::string before_;
};

TEST_F(TemporaryFolders, OfKilledDaemonsAreRemovedAndNobodyElses) {
  const TemporaryFolder held = TemporaryFolder::make().value();
  make_old(held.path());
  const fs::path left = orphan("metamerd-temporary-abc123");
  const fs::path other = orphan("metamerd-backup");
  const fs::path young = base_.path() / "metamerd-temporary-def456";
  fs::create_directory(young);
  fs::create_directory_symlink(other, base_.path() / "metamerd-temporary-linked");

  const TemporaryFolder made = TemporaryFolder::make().value();
  EXPECT_TRUE(fs::exists(made.path()));
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(held.path())) << "its daemon lives";
  EXPECT_TRUE(fs::exists(young)) << "its daemon may be about to lock it";
  EXPECT_TRUE(fs::exists(other / "assets" / "one")) << "not ours";
}

TEST_F(TemporaryFolders, AreGoneWithTheirDaemon) {
  fs::path path;
  {
    const TemporaryFolder folder = TemporaryFolder::make().value();
    path = folder.path();
    std::ofstream(path / "file") << "bytes";
  }
  EXPECT_FALSE(fs::exists(path));
}

}  // namespace
}  // namespace metamer::service
