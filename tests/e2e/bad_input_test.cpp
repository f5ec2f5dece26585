// Bad input gives its message at its place, exit code 2, and leaves the daemon alone.
#include <gtest/gtest.h>

#include "daemon.h"
#include "scenes.h"

namespace metamer::test {
namespace {

const std::string camera = "camera { eye { z: 4 } }\n";
const std::string light =
    "light { name: \"lamp\" position { y: 2 } spectrum { standard: \"D65\" } }\n";
const std::string material = "material { name: \"grey\" diffuse { constant: 0.5 } }\n";
const std::string object = "object { name: \"ball\" material: \"grey\" sphere { radius: 1 } }\n";

/// A scene in a folder of its own, given to `metamer` by its bare name.
class BadInput : public testing::Test {
 protected:
  Ended rendered(const std::string& scene, const std::vector<std::string>& more = {}) {
    folder.write("scene.txtpb", scene);
    ProcessOptions options;
    options.folder = folder.path();
    options.environment["METAMER_SERVER"] = daemon.address();
    std::vector<std::string> words = {"render", "scene.txtpb", "-o", "a.png"};
    words.insert(words.end(), more.begin(), more.end());
    return metamer(words, options);
  }

  void expect_message(const std::string& scene, const std::string& message,
                      const std::vector<std::string>& more = {}) {
    const Ended ended = rendered(scene, more);
    EXPECT_EQ(ended.code, 2) << scene;
    EXPECT_EQ(ended.out, "") << scene;
    EXPECT_EQ(ended.err, message) << scene;
  }

  void TearDown() override {
    // The daemon stays up and renders what is good.
    const Ended good = rendered(camera + light + material + object, {"--size", "16x16"});
    EXPECT_EQ(good.code, 0) << good.err;
  }

  Daemon daemon;
  Folder folder;
};

TEST_F(BadInput, NumberThatIsNotFinite) {
  expect_message(
      camera + light + material + "object { material: \"grey\" sphere { radius: nan } }\n",
      "scene.txtpb:4:45: error: radius must be finite (it is nan)\n"
      "object { material: \"grey\" sphere { radius: nan } }\n"
      "                                            ^\n");
}

TEST_F(BadInput, MissingFile) {
  expect_message(camera + light + material +
                     "object { material: \"grey\" mesh { file: \"meshes/bunny.ply\" } }\n",
                 "");
}

TEST_F(BadInput, FileOutsideTheScenesFolder) {
  expect_message(
      camera + light + material + "object { material: \"grey\" mesh { file: \"../bunny.ply\" } }\n",
      "");
}

TEST_F(BadInput, EmptyMesh) {
  folder.write("empty.obj", "# nothing\n");
  expect_message(
      camera + light + material + "object { material: \"grey\" mesh { file: \"empty.obj\" } }\n",
      "");
}

TEST_F(BadInput, MeshThatIsNoMesh) {
  folder.write("noise.ply", "\x01\x02\x03 this is no ply");
  expect_message(
      camera + light + material + "object { material: \"grey\" mesh { file: \"noise.ply\" } }\n",
      "");
}

TEST_F(BadInput, DuplicateName) {
  expect_message(camera + light + material + material + object, "");
}

TEST_F(BadInput, UnknownName) {
  expect_message(camera + light + material + "object { material: \"gray\" sphere { radius: 1 } }\n",
                 "");
}

TEST_F(BadInput, UnknownField) {
  expect_message(camera + light + material + "object { material: \"grey\" spehre { radius: 1 } }\n",
                 "");
}

TEST_F(BadInput, SizeOverTheLimit) {
  expect_message(camera + light + material + object + "settings { width: 20000 }\n", "");
}

TEST_F(BadInput, WavelengthsUnsorted) {
  expect_message(camera + light + material + object +
                     "settings { method { point { wavelengths: [400, 500, 450] } } }\n",
                 "");
}

TEST_F(BadInput, WavelengthsRepeated) {
  expect_message(camera + light + material + object +
                     "settings { method { point { wavelengths: [400, 500, 500] } } }\n",
                 "");
}

TEST_F(BadInput, SpectrumFileThatIsNone) {
  folder.write("spectra/paint.txt", "400 0.5\n410 half\n");
  expect_message(camera + light +
                     "material { name: \"grey\" diffuse { file: \"spectra/paint.txt\" } }\n" +
                     object,
                 "");
}

TEST_F(BadInput, ParameterOfAModelOutOfItsRange) {
  // Only the worker knows the models' ranges; its answer is located here.
  expect_message(camera + light +
                     "material {\n  name: \"grey\"\n  blinn_phong { shininess: 0.5 }\n}\n" + object,
                 "");
}

TEST_F(BadInput, AllProblemsAreTold) {
  expect_message(camera + light + material +
                     "object { material: \"grey\" sphere { radius: -1 } }\n"
                     "object { material: \"red\" sphere { radius: 1 } }\n",
                 "");
}

TEST_F(BadInput, OptionsAreToldByTheirNames) {
  expect_message(camera + light + light + material + object, "",
                 {"--spp", "0", "--light", "lamp=D66", "--samples", "400:700:0"});
  expect_message(camera + light + material + object,
                 "error: --light: no light named \"lmap\"; did you mean \"lamp\"?\n",
                 {"--light", "lmap=A"});
  expect_message(camera + light + material + object,
                 "error: --samples: \"400-700\" is not FROM:TO:STEP, such as 400:700:5\n",
                 {"--samples", "400-700"});
}

TEST_F(BadInput, SceneThatIsNotThere) {
  ProcessOptions options;
  options.folder = folder.path();
  const Ended ended = metamer({"render", "nowhere.txtpb", "-o", "a.png"}, options);
  EXPECT_EQ(ended.code, 2);
  EXPECT_EQ(ended.err, "nowhere.txtpb: error: file does not exist\n");
}

TEST_F(BadInput, WavelengthsOutsideTheDataAreNoted) {
  // No error, but worth knowing.
  const Ended ended = rendered(camera + light +
                                   "material { name: \"grey\" diffuse { samples { wavelength: "
                                   "[450, 650] value: [0, 1] } } }\n" +
                                   object,
                               {"--size", "16x16"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.err.find("scene.txtpb:3:26: note: "), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace metamer::test
