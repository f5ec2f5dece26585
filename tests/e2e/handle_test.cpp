// A job's number is of its server: it never gives one user another's picture.
#include <gtest/gtest.h>

#include <filesystem>

#include "daemon.h"
#include "scenes.h"

namespace metamer::test {
namespace {

TEST(JobHandle, FetchesNoOtherServersJobOfTheSameNumber) {
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const auto keeping = [&](const char* name) {
    return std::make_unique<Daemon>(Daemon::Listens::unix_socket,
                                    std::vector<std::string>{"--state", folder / name});
  };
  auto mine = keeping("mine");
  const auto theirs = keeping("theirs");
  const std::string handle = mine->submit(scene);
  ASSERT_EQ(handle.substr(0, 2), "1@");
  ASSERT_EQ(theirs->submit(scene).substr(0, 2), "1@");
  EXPECT_NE(mine->metamer({"jobs"}).out.find(handle), std::string::npos);

  // As it was printed, and by its number.
  EXPECT_EQ(mine->metamer({"fetch", handle, "-o", folder / "a.png"}).code, 0);
  EXPECT_EQ(mine->metamer({"fetch", "1", "-o", folder / "b.png"}).code, 0);

  const std::string wrong = folder / "wrong.png";
  const Ended refused = theirs->metamer({"fetch", handle, "-o", wrong});
  EXPECT_EQ(refused.code, 2) << refused.err;
  EXPECT_NE(refused.err.find("of another server"), std::string::npos) << refused.err;
  EXPECT_FALSE(std::filesystem::exists(wrong));

  // A restart keeps the name, a state that was thrown away does not.
  mine.reset();
  mine = keeping("mine");
  EXPECT_EQ(mine->metamer({"fetch", handle, "-o", folder / "c.png"}).code, 0);
  mine.reset();
  std::filesystem::remove_all(folder / "mine");
  mine = keeping("mine");
  ASSERT_EQ(mine->submit(scene).substr(0, 2), "1@");
  EXPECT_EQ(mine->metamer({"fetch", handle, "-o", wrong}).code, 2);
  EXPECT_FALSE(std::filesystem::exists(wrong));
}

}  // namespace
}  // namespace metamer::test
