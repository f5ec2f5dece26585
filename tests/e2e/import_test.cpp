// A mesh file that ends its reader is an error of its own job: the worker, its views and the next
// jobs go on.
#include <gtest/gtest.h>

#include <cstdlib>

#include "daemon.h"
#include "scenes.h"
#include "tests/common/mesh/gltf/gltf_text.h"
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

/// A glTF with its colours in itself: the file becomes a scene, and the scene a picture.
TEST(Import, AGltfsTextureIsInThePictureOfItsScene) {
  const Folder folder;
  GltfText text;
  const int positions = text.vec3({-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0}),
            uvs = text.accessor(std::vector<float>{0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 2),
            indices = text.accessor(std::vector<std::uint8_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 1);
  text.node_of({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}},
                {"indices", indices},
                {"material", 0}});
  nlohmann::json material = {{"name", "red"}};
  material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = 0;
  text.json["materials"] = {material};
  text.json["textures"] = {{{"source", 0}}};
  text.json["images"] = {
      {{"uri",
        "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADEl"
        "EQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC"}}};
  folder.write("a.glb", text.glb());
  ProcessOptions here;
  here.folder = folder.path();
  const Ended imported = metamer({"import", "a.glb", "-o", "a.txtpb"}, here);
  ASSERT_EQ(imported.code, 0) << imported.err;
  EXPECT_EQ(metamer({"import", "a.glb", "-o", "a.txtpb"}, here).code, 2);
  const Ended rendered =
      metamer({"render", "a.txtpb", "--size", "16x16", "-o", "a.exr", "--method", "exact"}, here);
  ASSERT_EQ(rendered.code, 0) << rendered.err;
  const Image picture = read_exr(folder / "a.exr");
  ASSERT_EQ(picture.width, 16);
  const float* const middle = picture.at(8, 8);
  EXPECT_GT(middle[0], 0.1f);
  EXPECT_NEAR(middle[1], 0, 0.01);
  EXPECT_NEAR(middle[2], 0, 0.01);
}

}  // namespace
}  // namespace metamer::test
