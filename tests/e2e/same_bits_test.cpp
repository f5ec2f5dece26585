// Who carries the scene, and how the work is cut, must not show in the picture.
#include <gtest/gtest.h>

#include "daemon.h"
#include "scenes.h"

namespace metamer::test {
namespace {

class SameBits : public testing::Test {
 protected:
  /// Renders with these words added, and reads the picture back.
  Image rendered(const std::vector<std::string>& more) {
    const std::string file = folder / ("picture" + std::to_string(++count) + ".exr");
    std::vector<std::string> words = {"render", scene, "-o", file, "--exr", "xyz"};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = metamer(words);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.out, file + "\n");
    return read_exr(file);
  }

  Folder folder;
  std::string scene = folder.write("scene.txtpb", small_scene());
  int count = 0;
};

TEST_F(SameBits, TcpDaemonUnixSocketAndPrivateDaemonGiveTheSamePicture) {
  const Daemon tcp(Daemon::Listens::tcp);
  const Daemon local(Daemon::Listens::unix_socket);
  const Image own = rendered({});
  expect_a_picture(own);
  expect_same_pixels(own, rendered({"--server", tcp.address()}), "TCP");
  expect_same_pixels(own, rendered({"--server", local.address()}), "Unix socket");
}

TEST_F(SameBits, NeitherThreadsNorTilesShow) {
  const Daemon daemon;
  for (const std::string method : {"point", "rgb", "exact", "linear", "prefilter"}) {
    const Image one = rendered(
        {"--server", daemon.address(), "--method", method, "--threads", "1", "--tile-size", "16"});
    expect_a_picture(one);
    for (const std::string threads : {"1", "2"}) {
      for (const std::string tile : {"8", "16", "64"}) {
        expect_same_pixels(one,
                           rendered({"--server", daemon.address(), "--method", method, "--threads",
                                     threads, "--tile-size", tile}),
                           method + ", " + threads + " threads, tiles of " + tile);
      }
    }
  }
}

TEST_F(SameBits, MethodsDiffer) {
  // The tests above could not fail if the pictures were all alike.
  const Daemon daemon;
  const Image point = rendered({"--server", daemon.address(), "--method", "point"});
  const Image rgb = rendered({"--server", daemon.address(), "--method", "rgb"});
  EXPECT_NE(point.pixels, rgb.pixels);
}

TEST_F(SameBits, SubmitAndFetchGiveWhatRenderGives) {
  const Daemon daemon;
  const Image direct = rendered({"--server", daemon.address()});
  const std::string job = daemon.submit(scene);
  const std::string file = folder / "fetched.exr";
  const Ended fetched = daemon.metamer({"fetch", job, "-o", file, "--exr", "xyz"});
  ASSERT_EQ(fetched.code, 0) << fetched.err;
  expect_same_pixels(direct, read_exr(file), "fetch");
}

}  // namespace
}  // namespace metamer::test
