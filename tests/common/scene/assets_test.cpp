#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "common/mesh/gltf/buffers.h"
#include "common/scene/limits.h"
#include "common/scene/scene_file.h"
#include "scene_text.h"

namespace metamer::test {
namespace {

namespace fs = std::filesystem;

/// A folder of its own for each test, with a scene's folder in it; gone afterwards.
class SceneAssets : public testing::Test {
 protected:
  SceneAssets() {
    std::string name = (fs::temp_directory_path() / "metamer-assets-XXXXXX").string();
    root_ = mkdtemp(name.data());
    folder_ = root_ / "scene";
    write("mesh/cube.ply", "ply\n");
    write("spectra/tcs.sp", "SPECT\n");
    write("../outside.ply", "secret\n");
  }
  ~SceneAssets() override { fs::remove_all(root_); }

  void write(const std::string& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  static v1::Scene meshes(const Strings& files) {
    v1::Scene scene;
    for (const std::string& file : files) scene.add_object()->mutable_mesh()->set_file(file);
    return scene;
  }

  Strings names(const v1::Scene& scene) {
    const auto assets = collect_assets(scene, folder_);
    Strings result;
    if (!assets) return describe(assets.error());
    for (const Asset& asset : *assets) result.push_back(asset.field + " " + asset.name);
    return result;
  }

  fs::path root_, folder_;
};

TEST_F(SceneAssets, EachFileOnceWithItsDigestInTheScenesOrder) {
  v1::Scene scene = meshes({"mesh/cube.ply", "mesh/cube.ply"});
  scene.add_material()->mutable_diffuse()->set_file("spectra/tcs.sp");
  scene.add_material()->mutable_specular()->set_file("spectra/tcs.sp");
  const auto assets = collect_assets(scene, folder_);
  ASSERT_TRUE(assets);
  ASSERT_EQ(assets->size(), 2u);
  EXPECT_EQ((*assets)[0].name, "spectra/tcs.sp");
  EXPECT_EQ((*assets)[0].field, "material[0].diffuse.file");
  EXPECT_EQ((*assets)[1].name, "mesh/cube.ply");
  EXPECT_EQ((*assets)[1].field, "object[0].mesh.file");
  EXPECT_EQ((*assets)[1].size, 4u);
  EXPECT_EQ((*assets)[1].sha256, sha256("ply\n"));
  EXPECT_EQ((*assets)[1].path, fs::canonical(folder_ / "mesh/cube.ply"));
}

TEST_F(SceneAssets, AnObserversFileIsOne) {
  write("eye.csv", "400,1,1,1\n");
  v1::Scene scene = meshes({"mesh/cube.ply"});
  scene.mutable_settings()->set_observer_file("eye.csv");
  EXPECT_EQ(names(scene),
            Strings({"settings.observer_file eye.csv", "object[0].mesh.file mesh/cube.ply"}));
  scene.mutable_settings()->set_observer_file("../outside.ply");
  EXPECT_EQ(names(scene),
            Strings({"settings.observer_file: file \"../outside.ply\" leads out of the "
                     "scene's folder"}));
}

TEST_F(SceneAssets, OfAFieldThatIsSaidToLieElsewhereAreTakenFromThere) {
  v1::Scene scene;
  scene.mutable_settings()->set_observer_file("../outside.ply");
  const Elsewhere elsewhere = {{"settings.observer_file", root_ / "outside.ply"}};
  const auto assets = collect_assets(scene, folder_, digest_file, elsewhere);
  ASSERT_TRUE(assets);
  ASSERT_EQ(assets->size(), 1u);
  EXPECT_EQ(assets->front().name, "../outside.ply");
  EXPECT_EQ(assets->front().sha256, sha256("secret\n"));

  // Its name must not be another's.
  scene.add_material()->mutable_diffuse()->set_file("spectra/tcs.sp");
  scene.mutable_settings()->set_observer_file("spectra/tcs.sp");
  const auto both = collect_assets(scene, folder_, digest_file, elsewhere);
  ASSERT_FALSE(both);
  EXPECT_EQ(describe(both.error()),
            Strings{"settings.observer_file: another file of the scene is called "
                    "\"spectra/tcs.sp\", too"});
  const auto none = collect_assets(scene, folder_, digest_file,
                                   {{"settings.observer_file", root_ / "nothing.csv"}});
  EXPECT_FALSE(none);
}

TEST_F(SceneAssets, PathsMayNotLeaveTheFolder) {
  EXPECT_EQ(names(meshes({"../outside.ply", "mesh/../../outside.ply", "/etc/passwd", ".."})),
            Strings({"object[0].mesh.file: file \"../outside.ply\" leads out of the scene's folder",
                     "object[1].mesh.file: file \"mesh/../../outside.ply\" leads out of the "
                     "scene's folder",
                     "object[2].mesh.file: file \"/etc/passwd\" must be relative to the scene's "
                     "folder",
                     "object[3].mesh.file: file \"..\" leads out of the scene's folder"}));
  EXPECT_EQ(names(meshes({"mesh/../mesh/./cube.ply"})),
            Strings({"object[0].mesh.file mesh/../mesh/./cube.ply"}));
}

TEST_F(SceneAssets, SymbolicLinksMayNotLeaveTheFolderEither) {
  fs::create_symlink("../outside.ply", folder_ / "link.ply");
  fs::create_directory_symlink("..", folder_ / "up");
  fs::create_symlink("mesh/cube.ply", folder_ / "inside.ply");
  fs::create_symlink("loop.ply", folder_ / "loop.ply");
  EXPECT_EQ(names(meshes({"link.ply", "up/outside.ply", "up"})),
            Strings({"object[0].mesh.file: file \"link.ply\" leads out of the scene's folder "
                     "through a symbolic link",
                     "object[1].mesh.file: file \"up/outside.ply\" leads out of the scene's folder "
                     "through a symbolic link",
                     "object[2].mesh.file: file \"up\" leads out of the scene's folder through a "
                     "symbolic link"}));
  EXPECT_EQ(names(meshes({"inside.ply"})), Strings({"object[0].mesh.file inside.ply"}));
  EXPECT_EQ(names(meshes({"loop.ply"})),
            Strings({"object[0].mesh.file: file \"loop.ply\" can't be read: Too many levels of "
                     "symbolic links"}));
}

TEST_F(SceneAssets, AFolderWhoseNameBeginsAlikeIsOutside) {
  write("../scene2/cube.ply", "ply\n");
  fs::create_directory_symlink("../scene2", folder_ / "link");
  EXPECT_EQ(names(meshes({"link/cube.ply"})),
            Strings({"object[0].mesh.file: file \"link/cube.ply\" leads out of the scene's folder "
                     "through a symbolic link"}));
}

TEST_F(SceneAssets, MissingFilesOfferTheNearestOne) {
  EXPECT_EQ(names(meshes({"mesh/cubes.ply", "other/cube.ply", "mesh/cube.ply/x.ply"})),
            Strings({"object[0].mesh.file: file \"mesh/cubes.ply\" does not exist; did you mean "
                     "\"mesh/cube.ply\"?",
                     "object[1].mesh.file: file \"other/cube.ply\" does not exist",
                     "object[2].mesh.file: file \"mesh/cube.ply/x.ply\" does not exist"}));
}

TEST_F(SceneAssets, AMissingFileIsNamedAlsoWhereNoneIsNear) {
  const auto assets = collect_assets(meshes({"mesh/cubes.ply", "other/cube.ply"}), folder_);
  ASSERT_EQ(assets.error().size(), 2u);
  EXPECT_EQ(assets.error()[0].was, "mesh/cubes.ply");
  EXPECT_EQ(assets.error()[0].meant, "mesh/cube.ply");
  EXPECT_EQ(assets.error()[1].was, "other/cube.ply");
  EXPECT_EQ(assets.error()[1].meant, "");
}

TEST_F(SceneAssets, WhatIsNoFileIsNamed) {
  ASSERT_EQ(mkfifo((folder_ / "pipe.ply").c_str(), 0600), 0);
  write("empty.ply", "");
  EXPECT_EQ(names(meshes({"mesh", ".", "pipe.ply", "empty.ply"})),
            Strings({"object[0].mesh.file: file \"mesh\" is a folder",
                     "object[1].mesh.file: file \".\" is a folder",
                     "object[2].mesh.file: file \"pipe.ply\" is not a regular file",
                     "object[3].mesh.file: file \"empty.ply\" is empty"}));
}

TEST_F(SceneAssets, FilesOverTheLimitAreNotRead) {
  // Sparse files: they take no room.
  write("big.ply", "x");
  fs::resize_file(folder_ / "big.ply", limits::max_asset + 1);
  write("big.sp", "x");
  fs::resize_file(folder_ / "big.sp", (16u << 20) + 1);
  v1::Scene scene = meshes({"big.ply"});
  scene.add_light()->mutable_spectrum()->set_file("big.sp");
  EXPECT_EQ(names(scene), Strings({"light[0].spectrum.file: file \"big.sp\" is too large (16777217 "
                                   "bytes; at most 16777216)",
                                   "object[0].mesh.file: file \"big.ply\" is too large (1073741825 "
                                   "bytes; at most 1073741824)"}));
}

TEST_F(SceneAssets, GltfBringsItsBuffers) {
  write("mesh/lamp.gltf",
        R"({"asset": {"version": "2.0"},
            "buffers": [{"uri": "lamp%20data.bin"}, {"uri": "data:;base64,AAAA"}]})");
  write("mesh/lamp data.bin", "123");
  EXPECT_EQ(names(meshes({"mesh/lamp.gltf"})), Strings({"object[0].mesh.file mesh/lamp.gltf",
                                                        "object[0].mesh.file mesh/lamp data.bin"}));
}

TEST_F(SceneAssets, GltfBuffersMayNotLeaveTheFolder) {
  write("mesh/lamp.gltf",
        R"({"asset": {}, "buffers": [{"uri": "../../outside.ply"}, {"uri": "gone.bin"}]})");
  EXPECT_EQ(names(meshes({"mesh/lamp.gltf"})),
            Strings({"object[0].mesh.file: \"mesh/lamp.gltf\" names a buffer: file "
                     "\"../outside.ply\" leads out of the scene's folder",
                     "object[0].mesh.file: \"mesh/lamp.gltf\" names a buffer: file "
                     "\"mesh/gone.bin\" does not exist"}));
}

TEST_F(SceneAssets, AFolderThatIsNotThereIsSaid) {
  const auto assets = collect_assets(meshes({"a.ply"}), root_ / "no");
  ASSERT_FALSE(assets);
  EXPECT_EQ(describe(assets.error()),
            Strings({"object[0].mesh.file: the scene's folder can't be read: No such file or "
                     "directory"}));
}

std::string gltf_error(const std::string& text) {
  const auto buffers = gltf_buffers(text, "a.gltf");
  return buffers ? std::string() : buffers.error().message;
}

TEST(GltfBuffers, FilesThatAreNotGltfAreRefused) {
  EXPECT_EQ(gltf_error("{"), "file \"a.gltf\" is not JSON");
  EXPECT_EQ(gltf_error(std::string(100'000, '[')), "file \"a.gltf\" is not JSON");
  EXPECT_EQ(gltf_error("[]"), "file \"a.gltf\" is not glTF 2.0");
  EXPECT_EQ(gltf_error("{}"), "file \"a.gltf\" is not glTF 2.0");
  EXPECT_EQ(gltf_error(R"({"asset": {}, "buffers": 5})"),
            "file \"a.gltf\" is not glTF 2.0: buffers is not a list");
  EXPECT_EQ(gltf_error(R"({"asset": {}, "buffers": [5]})"),
            "file \"a.gltf\" has a buffer without a URI");
  EXPECT_EQ(gltf_error(R"({"asset": {}, "buffers": [{"uri": 5}]})"),
            "file \"a.gltf\" has a buffer without a URI");
  EXPECT_EQ(gltf_error(R"({"asset": {}, "buffers": [{"uri": "http://x/y.bin"}]})"),
            "file \"a.gltf\" names the buffer \"http://x/y.bin\", which is not a file");
  EXPECT_EQ(gltf_error(R"({"asset": {}, "buffers": [{"uri": "a%2"}]})"),
            "file \"a.gltf\" names the buffer \"a%2\", which is not a URI");
  std::string many = R"({"asset": {}, "buffers": [{"uri": "a"})";
  for (int i = 0; i < 64; ++i) many += R"(, {"uri": "a"})";
  EXPECT_EQ(gltf_error(many + "]}"), "file \"a.gltf\" has too many buffers (65; at most 64)");
}

}  // namespace
}  // namespace metamer::test
