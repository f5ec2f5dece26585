// What is said to the kernel's files of a control group, and what is read from them. The files are
// a folder's: whether a kernel obeys is not asked here.

#include "server/service/executors/control_group.h"

#include <gtest/gtest.h>

#include <fstream>

#include "server/service/ops/folders.h"

namespace metamer::service::test {

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

class ControlGroupTest : public testing::Test {
 protected:
  TemporaryFolder folder_ = TemporaryFolder::make().value();
  fs::path delegated_ = folder_.path();
};

}  // namespace

TEST_F(ControlGroupTest, IsDividedOnceTheDaemonHasLeftIt) {
  ASSERT_TRUE(divide_control_group(delegated_));
  EXPECT_EQ(text_of(delegated_ / "daemon" / "cgroup.procs"), "0");
  EXPECT_EQ(text_of(delegated_ / "cgroup.subtree_control"), "+memory");
}

TEST_F(ControlGroupTest, ThatCanNotBeDividedIsLeftAsItIs) {
  fs::create_directories(delegated_ / "daemon" / "cgroup.procs");  // No file to write to.
  const auto divided = divide_control_group(delegated_);
  ASSERT_FALSE(divided);
  EXPECT_EQ(divided.error().message, "can't move into " + (delegated_ / "daemon").string());
  EXPECT_FALSE(fs::exists(delegated_ / "cgroup.subtree_control"));
}

TEST_F(ControlGroupTest, OfALaneIsToldItsLimitAndTellsWhatTheKernelEnded) {
  const ControlGroup lane(delegated_, "cpu views");
  EXPECT_EQ(lane.path(), delegated_ / "cpu-views");
  EXPECT_TRUE(lane.allow(std::uint64_t{3} << 40));
  EXPECT_EQ(text_of(lane.path() / "memory.max"), "3298534883328");
  EXPECT_EQ(lane.ended_for_memory(), 0u);
  std::ofstream(lane.path() / "memory.events") << "low 0\nhigh 0\nmax 31\noom 2\noom_kill 1\n";
  EXPECT_EQ(lane.ended_for_memory(), 1u);
  EXPECT_EQ(ControlGroup(delegated_, "cpu views").path(), lane.path());
}

TEST_F(ControlGroupTest, WhereThereIsNoneHoldsNothing) {
  const ControlGroup none;
  EXPECT_TRUE(none.path().empty());
  EXPECT_FALSE(none.allow(1));
  EXPECT_EQ(none.ended_for_memory(), 0u);
  EXPECT_TRUE(ControlGroup(delegated_ / "gone", "cpu").path().empty());
}

}  // namespace metamer::service::test
