// A scene of a mesh file has its colours, and says what stands for what.
#include "client/tools/mesh/import_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../temporary_folder.h"
#include "common/scene/scene_file.h"
#include "common/scene/validate.h"
#include "tests/common/mesh/gltf/gltf_text.h"

namespace metamer::client {
namespace {

const char* const obj_text =
    "mtllib colours of it.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
    "usemtl red\nf 1 2 3\nusemtl grey\nf 1 2 3\nusemtl lost\nf 1 2 3\n";
const char* const mtl_text =
    "newmtl red\nKd 0.8 0.1 0.05\nKs 0.5 0.25 0.5\nNs 250\nd 0.5\n"
    "newmtl grey\nKd 0.25 0.25 0.25\nKs 2 2 2\nNs 0.5\nmap_Kd x.png\n";

bool says(const std::vector<std::string>& sentences, const std::string& what) {
  return std::any_of(sentences.begin(), sentences.end(),
                     [&](const std::string& one) { return one.find(what) != std::string::npos; });
}

TEST(ImportScene, AnObjHasTheColoursOfItsMtl) {
  const TemporaryFolder folder;
  const std::string obj = folder.write("a.obj", obj_text);
  folder.write("colours of it.mtl", mtl_text);
  const auto scene = import_scene(obj, folder.file("."));
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->message.material_size(), 3);
  const v1::Material &red = scene->message.material(0), &grey = scene->message.material(1);
  EXPECT_EQ(red.name(), "red");
  EXPECT_EQ(red.diffuse().samples().value_size(), 36);
  EXPECT_EQ(red.diffuse().interpolation(), v1::Spectrum::LINEAR);
  EXPECT_EQ(red.specularness(), 0.5);
  EXPECT_EQ(red.blinn_phong().shininess(), 250);
  EXPECT_EQ(red.specular().samples().value_size(), 36);
  // Neutrals stay neutral, and what a highlight may not have is told.
  EXPECT_EQ(grey.diffuse().ShortDebugString(), "constant: 0.25");
  EXPECT_EQ(grey.specularness(), 1);
  EXPECT_EQ(grey.blinn_phong().shininess(), 1);
  EXPECT_FALSE(grey.has_specular());
  EXPECT_EQ(scene->message.material(2).diffuse().ShortDebugString(), "constant: 0.5");
  const auto& said = scene->left_out;
  EXPECT_TRUE(says(said,
                   "material \"red\": its base colour is #E7593F, and its d does not count; a "
                   "reflectance that looks so under D65 stands for it"));
  EXPECT_TRUE(says(said,
                   "times a texture; a reflectance that looks so under D65 stands for it; its "
                   "highlight is brought into the range of blinn_phong"));
  EXPECT_TRUE(says(said, "material \"lost\": no base colour of it is in the file"));
  EXPECT_TRUE(validate_scene(scene->message).empty());
  EXPECT_TRUE(SceneFile::parse(scene_text(*scene, obj), "s.txtpb"));
}

TEST(ImportScene, AnMtlThatIsNotThereOrElsewhereIsToldAndNothingElse) {
  for (const std::string name : {"gone.mtl", "../a.mtl", "/etc/passwd", "sub\\gone.mtl"}) {
    const TemporaryFolder folder;
    const std::string obj = folder.write(
        "a.obj", "mtllib " + name + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n");
    const auto scene = import_scene(obj, folder.file("."));
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(says(scene->left_out, "the materials of a .mtl: ")) << name;
    EXPECT_EQ(scene->message.material(0).diffuse().ShortDebugString(), "constant: 0.5");
  }
}

TEST(ImportScene, SeveralMtlsStandInOneLine) {
  const TemporaryFolder folder;
  const std::string obj =
      folder.write("a.obj", "mtllib a.mtl b.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl b\nf 1 2 3\n");
  folder.write("a.mtl", "newmtl a\nKd 1 1 1\n");
  folder.write("b.mtl", "newmtl b\nKd 0.125 0.125 0.125\n");
  const auto scene = import_scene(obj, folder.file("."));
  ASSERT_TRUE(scene);
  EXPECT_EQ(scene->message.material(0).diffuse().constant(), 0.125);
}

TEST(ImportScene, VertexColoursAreLeftOutWhicheverFormatHasThem) {
  const TemporaryFolder folder;
  const std::string obj =
      folder.write("a.obj", "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 0 1 0 1 0 0\nf 1 2 3\nf 1 1\n");
  const std::string ply = folder.write(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
      "float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 2\n"
      "property list uchar int vertex_indices\nend_header\n"
      "0 0 0 9 9 9\n1 0 0 9 9 9\n0 1 0 9 9 9\n3 0 1 2\n2 0 1\n");
  for (const std::string& file : {obj, ply}) {
    const auto scene = import_scene(file, folder.file("."));
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_TRUE(says(scene->left_out, "vertex colours (")) << file;
    EXPECT_FALSE(says(scene->left_out, "says no colour")) << file;
    EXPECT_TRUE(says(scene->left_out, "1 face that spans no triangle")) << file;
  }
}

/// A .gltf in a folder, imported.
Result<ImportedScene> import_gltf(const GltfText& text, const TemporaryFolder& folder) {
  folder.write("a.bin", text.binary());
  return import_scene(folder.write("a.gltf", text.gltf()), folder.file("."));
}

TEST(ImportScene, WhatAGltfHasAndASceneHasNotIsNamedOnceWithWhatItIsOf) {
  GltfText text;
  const int positions = text.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const nlohmann::json attributes = {{"POSITION", positions}, {"COLOR_0", positions}};
  text.node_of({{"attributes", attributes}, {"material", 0}})["name"] = "bottle";
  text.json["nodes"][0]["skin"] = 0;
  text.json["skins"] = {{{"joints", {0}}}};
  for (const int mode : {1, 0, 1})
    text.json["meshes"][0]["primitives"].push_back(
        {{"attributes", attributes}, {"mode", mode}, {"material", 1}});
  text.json["materials"] = {
      {{"name", "glass"},
       {"emissiveFactor", {0, 1, 0}},
       {"alphaMode", "BLEND"},
       {"normalTexture", {{"index", 0}}},
       {"occlusionTexture", {{"index", 0}}},
       {"emissiveTexture", {{"index", 0}}},
       {"pbrMetallicRoughness",
        {{"roughnessFactor", 0.25},
         {"metallicFactor", 0},
         {"metallicRoughnessTexture", {{"index", 0}}}}},
       {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}},
      {{"name", "wire"}, {"alphaMode", "MASK"}}};
  text.json["textures"] = {{{"source", 0}}};
  text.json["images"] = {{{"uri", "x.png"}}};
  text.json["scenes"].push_back({{"name", "other"}});
  text.json["extensionsUsed"] = {"KHR_materials_transmission", "KHR_materials_variants",
                                 "KHR_lights_punctual", "KHR_texture_transform"};
  const TemporaryFolder folder;
  const auto scene = import_gltf(text, folder);
  ASSERT_TRUE(scene) << scene.error().message;
  for (const char* what :
       {"vertex colours (COLOR_0) of \"bottle\"", "skins",
        "lines of \"bottle\", whose material is \"wire\"",
        "points of \"bottle\", whose material is \"wire\"", "its emissiveFactor does not count",
        "its alphaMode BLEND does not count", "its normalTexture does not count",
        "its occlusionTexture does not count", "its emissiveTexture does not count",
        "its roughnessFactor does not count", "its metallicRoughnessTexture does not count",
        "its KHR_materials_transmission does not count", "the extension \"KHR_materials_variants\"",
        "all scenes but the one that the file shows first"}) {
    const std::string all = scene_text(*scene, "a.gltf");
    const std::size_t first = all.find(what);
    EXPECT_NE(first, std::string::npos) << what << "\n" << all;
    EXPECT_EQ(all.find(what, first + 1), std::string::npos) << what << "\n" << all;
  }
  for (const char* what : {"KHR_lights_punctual", "KHR_texture_transform", "spans no triangle"})
    EXPECT_FALSE(says(scene->left_out, what)) << what;
}

TEST(ImportScene, WhatAGltfSaysByDefaultIsNotLeftOut) {
  GltfText text;
  text.node_of(
      {{"attributes", {{"POSITION", text.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}, {"material", 0}});
  text.json["materials"] = {
      {{"name", "paint"},
       {"alphaMode", "OPAQUE"},
       {"emissiveFactor", {0, 0, 0}},
       {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"roughnessFactor", 1}}}}};
  const TemporaryFolder folder;
  const auto scene = import_gltf(text, folder);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_FALSE(says(scene->left_out, "does not count"));
}

/// A floor of 20 m by 20 m with lights of KHR_lights_punctual above its middle.
GltfText lit_floor(const nlohmann::json& lights, double height) {
  GltfText text;
  const int positions = text.vec3({-10, 0, -10, -10, 0, 10, 10, 0, 10, 10, 0, -10});
  const int indices = text.accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 2, 3}, "SCALAR", 1);
  text.node_of({{"attributes", {{"POSITION", positions}}}, {"indices", indices}});
  text.json["extensions"]["KHR_lights_punctual"]["lights"] = lights;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    text.json["nodes"].push_back(
        {{"translation", {0, height, 0}},
         {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}},  // −z becomes −y.
         {"extensions", {{"KHR_lights_punctual", {{"light", i}}}}}});
    text.json["scenes"][0]["nodes"].push_back(i + 1);
  }
  return text;
}

TEST(ImportScene, LightsBringAllButAThousandthOfTheSurfacesIntoThePicturesRange) {
  // Of a lamp at height h, E = I h / (h² + r²)^(3/2) at a distance r from the middle, and a
  // thousandth of the floor's 400 m² is within r² = 0.4 / π.
  for (const double height : {0.05, 1.0, 3.0, 50.0}) {
    const TemporaryFolder folder;
    const auto scene =
        import_gltf(lit_floor({{{"type", "point"}, {"intensity", 700}}}, height), folder);
    ASSERT_TRUE(scene) << scene.error().message;
    ASSERT_EQ(scene->message.light_size(), 1);
    const v1::Light& light = scene->message.light(0);
    const double away = height * height + 0.4 / std::numbers::pi;
    const double top =
        light.luminance() * std::pow(light.reference_distance(), 2) * height / std::pow(away, 1.5);
    EXPECT_NEAR(top, 1, 0.15) << height;
  }
}

TEST(ImportScene, LightsAddUpAndKeepTheirProportions) {
  const TemporaryFolder folder;
  const auto scene = import_gltf(lit_floor({{{"type", "directional"}, {"intensity", 3}},
                                            {{"type", "directional"}, {"intensity", 1}}},
                                           2),
                                 folder);
  ASSERT_TRUE(scene) << scene.error().message;
  ASSERT_EQ(scene->message.light_size(), 2);
  EXPECT_NEAR(scene->message.light(0).luminance(), 0.75, 1e-6);
  EXPECT_NEAR(scene->message.light(1).luminance(), 0.25, 1e-6);
}

TEST(ImportScene, MoreLightsThanASceneMayHaveAreLeftOut) {
  const TemporaryFolder folder;
  const nlohmann::json lamp = {{"type", "point"}};
  const auto scene = import_gltf(lit_floor(nlohmann::json(300, lamp), 2), folder);
  ASSERT_TRUE(scene) << scene.error().message;
  EXPECT_EQ(scene->message.light_size(), 256);
  EXPECT_TRUE(says(scene->left_out, "all lights but the first 256"));
  EXPECT_TRUE(validate_scene(scene->message).empty());
}

TEST(ImportScene, ALightThatShinesOnNothingOrNotAtAllLeavesASoundScene) {
  for (const nlohmann::json& light :
       {nlohmann::json{{"type", "spot"}, {"intensity", 5}, {"spot", {{"outerConeAngle", 1e-6}}}},
        nlohmann::json{{"type", "point"}, {"intensity", 0}},
        nlohmann::json{{"type", "point"}, {"intensity", 1e30}}})
    for (const double height : {0.0, 2.0}) {
      const TemporaryFolder folder;
      const auto scene = import_gltf(lit_floor(nlohmann::json::array({light}), height), folder);
      ASSERT_TRUE(scene) << scene.error().message;
      EXPECT_EQ(scene->message.light_size(), 1);
      const auto problems = validate_scene(scene->message);
      EXPECT_TRUE(problems.empty()) << light << height << problems.front().message;
    }
}

}  // namespace
}  // namespace metamer::client
