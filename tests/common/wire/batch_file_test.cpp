#include "common/wire/batch_file.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <fstream>
#include <iterator>

namespace metamer::wire {
namespace {

class BatchFile : public testing::Test {
 protected:
  BatchFile() {
    std::string path = "/tmp/metamer-batch-XXXXXX";
    folder_ = ::mkdtemp(path.data());
    file_ = folder_ / "7.result";
    result_.set_attempt(7);
    result_.add_tile()->set_xyz("twelve bytes");
  }
  ~BatchFile() override { std::filesystem::remove_all(folder_); }

  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  void replace(const std::string& bytes) const { std::ofstream(file_, std::ios::binary) << bytes; }
  std::size_t files() const {
    const std::filesystem::directory_iterator all(folder_);
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
  }

  std::filesystem::path folder_, file_;
  v1::BatchResult result_;
};

TEST_F(BatchFile, ComesBackAsItWasWrittenAndLeavesNothingBeside) {
  ASSERT_TRUE(write_batch_file(file_, result_));
  EXPECT_EQ(files(), 1u);
  const auto read = read_batch_result(file_);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->SerializeAsString(), result_.SerializeAsString());
}

TEST_F(BatchFile, IsAnErrorWithAnyByteMissingOrChanged) {
  ASSERT_TRUE(write_batch_file(file_, result_));
  const std::string whole = bytes();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    replace(whole.substr(0, i));
    EXPECT_FALSE(read_batch_result(file_)) << i;
    std::string changed = whole;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    replace(changed);
    EXPECT_FALSE(read_batch_result(file_)) << i;
  }
  replace(whole + "x");
  EXPECT_FALSE(read_batch_result(file_));
}

TEST_F(BatchFile, ThatIsNoneOrCantBeWrittenIsAnErrorThatNamesIt) {
  const auto absent = read_batch_result(file_);
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error().message, file_.string() + ": No such file or directory");
  EXPECT_FALSE(read_batch_order(folder_));
  const auto nowhere = write_batch_file(folder_ / "none" / "1.result", result_);
  ASSERT_FALSE(nowhere);
  EXPECT_NE(nowhere.error().message.find("No such file"), std::string::npos);
}

}  // namespace
}  // namespace metamer::wire
