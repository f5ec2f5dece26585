// A mesh file that ends its reader is an error of its own job: the worker, its views and the next
// jobs go on.
#include <gtest/gtest.h>

#include <cstdlib>

#include "daemon.h"
#include "scenes.h"
#include "viewer.h"

namespace metamer::test {
namespace {

/// While it is there, readers of mesh files in workers that start do what the word says.
struct Readers {
  explicit Readers(const char* word) { setenv("METAMER_TEST_IMPORT", word, 1); }
  ~Readers() { unsetenv("METAMER_TEST_IMPORT"); }
};

TEST(Import, AFileThatEndsItsReaderFailsItsJobAndNobodyElses) {
  const Readers readers("abort");
  const Daemon daemon;
  const Folder folder;
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string scene =
      folder.write("a.txtpb",
                   "camera { eye { z: 4 } }\n"
                   "light { name: \"lamp\" position { y: 2 } spectrum { standard: \"D65\" } }\n"
                   "material { name: \"grey\" }\n"
                   "object { material: \"grey\" mesh { file: \"a.obj\" } }\n");
  Viewer viewer(daemon);
  const auto view = viewer.open(direct_scene(), v1::CPU);
  ASSERT_TRUE(view) << viewer.error().message;
  const pid_t worker = daemon.worker_pid();

  for (int i = 0; i < 3; ++i) {
    const Ended ended = daemon.metamer({"render", scene, "-o", folder / "a.png"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(ended.err, scene +
                             ":4:34: error: \"a.obj\" can't be read: its reader ended by a signal: "
                             "Aborted\n"
                             "object { material: \"grey\" mesh { file: \"a.obj\" } }\n"
                             "                                 ^\n");
    viewer.ask(*view);
    EXPECT_TRUE(viewer.next(*view)) << viewer.error().message;
  }
  EXPECT_EQ(daemon.worker_pid(), worker);
  const std::string good = folder.write("good.txtpb", small_scene());
  EXPECT_EQ(daemon.metamer({"render", good, "-o", folder / "good.exr"}).code, 0);
}

}  // namespace
}  // namespace metamer::test
