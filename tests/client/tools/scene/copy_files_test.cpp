// A scene's files go with it to another folder.
#include "client/tools/scene/copy_files.h"

#include <gtest/gtest.h>

#include "common/scene/files.h"
#include "tests/client/tools/temporary_folder.h"

namespace metamer::client {
namespace {

using Names = std::vector<std::string>;

TEST(CopyFiles, WithTheFoldersInBetweenAndOverNothing) {
  const TemporaryFolder from, to;
  std::filesystem::create_directories(from.file("spectra/deep"));
  from.write("a.csv", "a");
  from.write("b.csv", "b");
  from.write("spectra/deep/c.csv", "c");
  to.write("a.csv", "a");
  to.write("b.csv", "another");
  const auto done =
      copy_files({"a.csv", "b.csv", "spectra/deep/c.csv"}, from.file(""), to.file(""));
  ASSERT_TRUE(done.has_value());
  EXPECT_EQ(done->same, Names{"a.csv"});
  EXPECT_EQ(done->kept, Names{"b.csv"});
  EXPECT_EQ(done->copied, Names{"spectra/deep/c.csv"});
  EXPECT_EQ(*read_file(to.file("b.csv"), 100), "another");
  EXPECT_EQ(*read_file(to.file("spectra/deep/c.csv"), 100), "c");
}

TEST(CopyFiles, WhatLiesElsewhereOrIsNotThereIsAProblem) {
  const TemporaryFolder from, to;
  EXPECT_FALSE(copy_files({"../x"}, from.file(""), to.file("")).has_value());
  EXPECT_FALSE(copy_files({"/etc/hostname"}, from.file(""), to.file("")).has_value());
  EXPECT_FALSE(copy_files({""}, from.file(""), to.file("")).has_value());
  const auto gone = copy_files({"gone.csv"}, from.file(""), to.file(""));
  ASSERT_FALSE(gone.has_value());
  EXPECT_EQ(gone.error().message, "\"gone.csv\" can't be copied: No such file or directory");
}

}  // namespace
}  // namespace metamer::client
