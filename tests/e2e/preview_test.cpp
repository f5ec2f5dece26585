// A picture to look at while the job runs.
#include <gtest/gtest.h>

#include <algorithm>

#include "running_job.h"

namespace metamer::test {
namespace {

TEST(Preview, FileIsKeptUpToDateToTheEnd) {
  const Daemon daemon(Daemon::Listens::unix_socket, {"--worker-timeout", "60"});
  const Folder folder;
  const std::string file = folder / "preview.png";
  const std::string job = daemon.submit(folder.write("long.txtpb", long_scene()));
  const auto watcher = daemon.start({"watch", job, "--preview", file});

  // In the middle a part of it is there, and black where nothing is yet.
  ASSERT_TRUE(watcher->line_out("preview 214x160"));
  HeldWorkers held(daemon);
  const Result<Image> part = read_image(file);
  ASSERT_TRUE(part);
  expect_a_picture(*part);
  held.release();

  // At the end it is whole: darker nowhere, and brighter somewhere.
  EXPECT_EQ(watcher->wait().code, 0);
  const Result<Image> whole = read_image(file);
  ASSERT_TRUE(whole);
  ASSERT_EQ(whole->pixels.size(), part->pixels.size());
  const auto lit = [](const Image& image) {
    return std::count_if(image.pixels.begin(), image.pixels.end(), [](float v) { return v > 0; });
  };
  EXPECT_GT(lit(*whole), lit(*part));
}

TEST(Preview, OfAJobThatEndedBeforeIsNotThere) {
  const Daemon daemon;
  const Folder folder;
  const std::string job = daemon.submit(folder.write("small.txtpb", small_scene()));
  EXPECT_EQ(daemon.metamer({"watch", job}).code, 0);
  const Ended ended = daemon.metamer({"watch", job, "--preview", folder / "late.png"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.err, "note: the job sent no preview; metamer fetch gets its picture\n");
}

TEST(Preview, IsAPng) {
  const Daemon daemon;
  const Ended ended = daemon.metamer({"watch", "1", "--preview", "a.exr"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.err, "error: --preview: \"a.exr\" does not end in .png\n");
}

}  // namespace
}  // namespace metamer::test
