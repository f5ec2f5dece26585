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
      "scene.txtpb:4:36: error: radius must be finite (it is nan)\n"
      "object { material: \"grey\" sphere { radius: nan } }\n"
      "                                   ^\n");
}

TEST_F(BadInput, MissingFile) {
  expect_message(camera + light + material +
                     "object { material: \"grey\" mesh { file: \"meshes/bunny.ply\" } }\n",
                 "scene.txtpb:4:34: error: file \"meshes/bunny.ply\" does not exist\n"
                 "object { material: \"grey\" mesh { file: \"meshes/bunny.ply\" } }\n"
                 "                                 ^\n");
}

// The worker has no files but the scene's, and the C library keeps its encodings in files.
TEST_F(BadInput, IsNotATextInUtf16OrLatin1) {
  const std::string table = "nm;Gr\xFCn;Blau\n400;0.1;0.3\n500;0.5;0.2\n700;0.2;0.1\n";
  std::string wide = "\xFF\xFE";
  for (const char c : table) wide += {c, '\0'};
  folder.write("latin1.csv", table);
  folder.write("utf16.csv", wide);
  for (const std::string file : {"latin1.csv", "utf16.csv"}) {
    const Ended ended =
        rendered(camera + light + object + "material { name: \"grey\" diffuse { file: \"" + file +
                     "\" entry: \"Gr\xC3\xBCn\" } }\n",
                 {"--size", "16x16"});
    EXPECT_EQ(ended.code, 0) << ended.err;
  }
}

TEST_F(BadInput, FileOutsideTheScenesFolder) {
  expect_message(
      camera + light + material + "object { material: \"grey\" mesh { file: \"../bunny.ply\" } }\n",
      "scene.txtpb:4:34: error: file \"../bunny.ply\" leads out of the scene's folder\n"
      "object { material: \"grey\" mesh { file: \"../bunny.ply\" } }\n"
      "                                 ^\n");
}

TEST_F(BadInput, EmptyMesh) {
  folder.write("empty.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n# and no face\n");
  expect_message(
      camera + light + material + "object { material: \"grey\" mesh { file: \"empty.obj\" } }\n",
      "scene.txtpb:4:34: error: \"empty.obj\" holds no triangles\n"
      "object { material: \"grey\" mesh { file: \"empty.obj\" } }\n"
      "                                 ^\n");
}

TEST_F(BadInput, MeshThatIsNoMesh) {
  folder.write("noise.ply", "\x01\x02\x03 this is no ply");
  expect_message(
      camera + light + material + "object { material: \"grey\" mesh { file: \"noise.ply\" } }\n",
      "noise.ply:1: error: a PLY begins with the line \"ply\"\n??? this is no ply\n");
}

TEST_F(BadInput, DuplicateName) {
  expect_message(
      camera + light + material + material + object,
      "scene.txtpb:4:12: error: material \"grey\" is defined twice (first as material[0])\n"
      "material { name: \"grey\" diffuse { constant: 0.5 } }\n"
      "           ^\n");
}

TEST_F(BadInput, UnknownName) {
  expect_message(
      camera + light + material + "object { material: \"gray\" sphere { radius: 1 } }\n",
      "scene.txtpb:4:10: error: material \"gray\" is not defined; did you mean \"grey\"?\n"
      "object { material: \"gray\" sphere { radius: 1 } }\n"
      "         ^\n");
}

TEST_F(BadInput, UnknownField) {
  expect_message(
      camera + light + material + "object { material: \"grey\" spehre { radius: 1 } }\n",
      "scene.txtpb:4:27: error: Object has no field \"spehre\"; did you mean \"sphere\"?\n"
      "object { material: \"grey\" spehre { radius: 1 } }\n"
      "                          ^\n");
}

TEST_F(BadInput, SizeOverTheLimit) {
  expect_message(camera + light + material + object + "settings { width: 20000 }\n",
                 "scene.txtpb:5:12: error: width must lie in 1..16384 (it is 20000)\n"
                 "settings { width: 20000 }\n"
                 "           ^\n");
}

TEST_F(BadInput, WavelengthsUnsorted) {
  expect_message(camera + light + material + object +
                     "settings { method { point { wavelengths: [400, 500, 450] } } }\n",
                 "scene.txtpb:5:53: error: wavelengths must rise (450 comes after 500)\n"
                 "settings { method { point { wavelengths: [400, 500, 450] } } }\n"
                 "                                                    ^\n");
}

TEST_F(BadInput, WavelengthsRepeated) {
  expect_message(camera + light + material + object +
                     "settings { method { point { wavelengths: [400, 500, 500] } } }\n",
                 "scene.txtpb:5:53: error: wavelengths must not repeat (500 is there twice)\n"
                 "settings { method { point { wavelengths: [400, 500, 500] } } }\n"
                 "                                                    ^\n");
}

TEST_F(BadInput, SpectrumFileThatIsNone) {
  folder.write("spectra/paint.txt", "400 0.5\n410 half\n");
  expect_message(camera + light +
                     "material { name: \"grey\" diffuse { file: \"spectra/paint.txt\" } }\n" +
                     object,
                 "spectra/paint.txt:2:5: error: \"half\" is not a number\n"
                 "410 half\n"
                 "    ^\n");
}

TEST_F(BadInput, ParameterOfAModelOutOfItsRange) {
  expect_message(camera + light +
                     "material {\n  name: \"grey\"\n  blinn_phong { shininess: 0.5 }\n}\n" + object,
                 "scene.txtpb:5:17: error: shininess must lie in 1..1e+06 (it is 0.5); the "
                 "nearest allowed value is 1\n"
                 "  blinn_phong { shininess: 0.5 }\n"
                 "                ^\n");
}

TEST_F(BadInput, AllProblemsAreTold) {
  expect_message(camera + light + material +
                     "object { material: \"grey\" sphere { radius: -1 } }\n"
                     "object { material: \"red\" sphere { radius: 1 } }\n",
                 "scene.txtpb:4:36: error: radius must be above 0 (it is -1)\n"
                 "object { material: \"grey\" sphere { radius: -1 } }\n"
                 "                                   ^\n"
                 "scene.txtpb:5:10: error: material \"red\" is not defined\n"
                 "object { material: \"red\" sphere { radius: 1 } }\n"
                 "         ^\n");
}

TEST_F(BadInput, OptionsAreToldByTheirNames) {
  expect_message(camera + light + light + material + object,
                 "error: --light: \"D66\" is not a standard illuminant; did you mean \"D65\"?\n"
                 "scene.txtpb:3:9: error: light \"lamp\" is defined twice (first as light[0])\n"
                 "light { name: \"lamp\" position { y: 2 } spectrum { standard: \"D65\" } }\n"
                 "        ^\n"
                 "error: --samples: step must be above 0 (it is 0)\n"
                 "error: --spp: spp must lie in 1..1024 (it is 0)\n",
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
  for (const std::string note : {"scene.txtpb:3:25: note: its data end at 450 and 650 nm: ",
                                 "a.png: note: 24 pixels outside the sRGB gamut, clipped\n"})
    EXPECT_NE(ended.err.find(note), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace metamer::test
