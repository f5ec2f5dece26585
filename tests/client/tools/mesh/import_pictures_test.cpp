// A scene of a glTF has the pictures of its materials, and says which it has not.
#include "client/tools/mesh/import_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../temporary_folder.h"
#include "client/tools/mesh/import_scene.h"
#include "common/scene/scene_file.h"
#include "common/scene/validate.h"
#include "tests/common/mesh/gltf/gltf_text.h"
#include "tests/server/scene/small_png.h"

namespace metamer::client {
namespace {

const std::string rgb_png = test::small_png(1, 1, 2, {'\x10', '\x20', '\x30'}),
                  rgba_png = test::small_png(1, 1, 6, {'\x10', '\x20', '\x30', '\x40'}),
                  grey_png = test::small_png(1, 1, 0, {'\x10'});

/// A triangle with UVs whose material is `material`; `image` for the JSON, as it is.
GltfText textured(const nlohmann::json& material, const nlohmann::json& image) {
  GltfText text;
  const int positions = text.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0}),
            uvs = text.accessor(std::vector<float>{0, 0, 1, 0, 0, 1}, "VEC2", 2);
  text.node_of({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", uvs}}}, {"material", 0}});
  text.json["materials"] = {material};
  text.json["materials"][0]["name"] = "leaf";
  text.json["textures"] = {{{"source", 0}}};
  text.json["images"] = {image};
  return text;
}

ImportedScene imported_of(const GltfText& text, const TemporaryFolder& folder) {
  folder.write("a.bin", text.binary());
  auto scene = import_scene(folder.write("a.gltf", text.gltf()), folder.file("."));
  EXPECT_TRUE(scene) << scene.error().message;
  if (!scene) return {};
  const auto problems = validate_scene(scene->message);
  EXPECT_TRUE(problems.empty()) << problems.front().field << problems.front().message;
  return *std::move(scene);
}

const nlohmann::json base_color = {{"baseColorTexture", {{"index", 0}}}};

std::string sentence(const ImportedScene& scene) {
  for (const std::string& one : scene.left_out)
    if (one.starts_with("material \"leaf\"")) return one;
  return "";
}

TEST(ImportPictures, APngBesideTheMeshIsNamedWhereItIs) {
  const TemporaryFolder folder;
  folder.write("x y.png", rgb_png);
  const ImportedScene scene =
      imported_of(textured({{"pbrMetallicRoughness", base_color}}, {{"uri", "x%20y.png"}}), folder);
  const v1::Material& material = scene.message.material(0);
  EXPECT_EQ(material.texture().ShortDebugString(), "file: \"x y.png\" use: RGB");
  EXPECT_FALSE(material.has_diffuse());
  EXPECT_FALSE(material.has_alpha());
  EXPECT_TRUE(scene.files.empty());
  EXPECT_EQ(sentence(scene).find("material \"leaf\": its colours are those of \"x y.png\""), 0u);
}

TEST(ImportPictures, OneWithinTheFileIsWrittenBesideTheScene) {
  const std::string base64 =
      "iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/"
      "pLvAAAAAElFTkSuQmCC";
  GltfText view =
      textured({{"pbrMetallicRoughness", base_color}}, {{"bufferView", 2}, {"name", "bark/../x"}});
  view.accessor(std::vector<std::uint8_t>(rgb_png.begin(), rgb_png.end()), "SCALAR", 1);
  for (const GltfText& text :
       {textured({{"pbrMetallicRoughness", base_color}},
                 {{"uri", "data:image/png;base64," + base64}, {"name", "bark/../x"}}),
        view}) {
    const TemporaryFolder folder;
    const ImportedScene scene = imported_of(text, folder);
    ASSERT_EQ(scene.files.size(), 1u);
    EXPECT_EQ(scene.files[0].name, "a-bark____x.png");
    EXPECT_EQ(scene.message.material(0).texture().file(), "a-bark____x.png");
    EXPECT_EQ(std::string(scene.files[0].bytes.begin(), scene.files[0].bytes.end()).find("\x89PNG"),
              0u);
  }
}

TEST(ImportPictures, MaskIsACutoffAndBlendAShare) {
  for (const std::string mode : {"MASK", "BLEND", "OPAQUE"}) {
    nlohmann::json material = {{"pbrMetallicRoughness", base_color}, {"alphaMode", mode}};
    material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 1};
    if (mode == "MASK") {
      material["alphaCutoff"] = 0.3;
      material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.5};
    }
    const TemporaryFolder folder;
    folder.write("x.png", rgba_png);
    const v1::Map alpha =
        imported_of(textured(material, {{"uri", "x.png"}}), folder).message.material(0).alpha();
    EXPECT_EQ(alpha.ShortDebugString(), mode == "MASK"    ? "file: \"x.png\" cutoff: 0.6"
                                        : mode == "BLEND" ? "file: \"x.png\""
                                                          : "");
  }
  // Colours without alpha are all there.
  const TemporaryFolder folder;
  folder.write("x.png", rgb_png);
  EXPECT_FALSE(imported_of(textured({{"pbrMetallicRoughness", base_color}, {"alphaMode", "BLEND"}},
                                    {{"uri", "x.png"}}),
                           folder)
                   .message.material(0)
                   .has_alpha());
}

TEST(ImportPictures, NormalsHaveTheirScale) {
  const TemporaryFolder folder;
  folder.write("x.png", rgb_png);
  const ImportedScene scene = imported_of(
      textured({{"normalTexture", {{"index", 0}, {"scale", 0.5}}}}, {{"uri", "x.png"}}), folder);
  EXPECT_EQ(scene.message.material(0).normal_map().ShortDebugString(),
            "file: \"x.png\" strength: 0.5");
  EXPECT_EQ(sentence(scene).find("normalTexture"), std::string::npos);
}

TEST(ImportPictures, AGreyFactorDarkensAndAColouredOneIsTold) {
  const TemporaryFolder folder;
  folder.write("x.png", rgb_png);
  nlohmann::json material = {{"pbrMetallicRoughness", base_color}};
  material["pbrMetallicRoughness"]["baseColorFactor"] = {0.25, 0.25, 0.25, 1};
  EXPECT_EQ(
      imported_of(textured(material, {{"uri", "x.png"}}), folder).message.material(0).diffuseness(),
      0.25);
  material["pbrMetallicRoughness"]["baseColorFactor"] = {1, 0, 0, 1};
  EXPECT_NE(sentence(imported_of(textured(material, {{"uri", "x.png"}}), folder))
                .find("its base colour #FF0000 does not count"),
            std::string::npos);
}

TEST(ImportPictures, SamplersAndTransformsPlaceThem) {
  // The example of KHR_texture_transform: the lower left quarter, turned clockwise by 90°.
  nlohmann::json info = {{"index", 0}};
  info["extensions"]["KHR_texture_transform"] = {
      {"offset", {0, 1}}, {"rotation", std::numbers::pi / 2}, {"scale", {0.5, 0.5}}};
  GltfText text =
      textured({{"pbrMetallicRoughness", {{"baseColorTexture", info}}}}, {{"uri", "x.png"}});
  text.json["textures"][0]["sampler"] = 0;
  text.json["samplers"] = {{{"wrapS", 33648}, {"wrapT", 33071}}};
  text.json["extensionsUsed"] = {"KHR_texture_transform"};
  const TemporaryFolder folder;
  folder.write("x.png", rgb_png);
  const ImportedScene scene = imported_of(text, folder);
  const v1::Texture& texture = scene.message.material(0).texture();
  EXPECT_EQ(texture.wrap(), v1::Texture::MIRROR);
  EXPECT_NE(sentence(scene).find("its wrapT is taken as its wrapS"), std::string::npos);
  const double angle = texture.rotation() * std::numbers::pi / 180;
  const auto at = [&](double u, double v) {
    u *= texture.scale().u();
    v *= texture.scale().v();
    return std::array{std::cos(angle) * u - std::sin(angle) * v + texture.offset().u(),
                      std::sin(angle) * u + std::cos(angle) * v + texture.offset().v()};
  };
  // Of UVs that rise, corner by corner: u, v of the mesh, and where the picture is read.
  const std::array<double, 4> corners[] = {
      {0, 0, 0.5, 0}, {1, 0, 0.5, 0.5}, {1, 1, 0, 0.5}, {0, 1, 0, 0}};
  for (const auto& [u, v, x, y] : corners) {
    EXPECT_NEAR(at(u, v)[0], x, 1e-9) << u << v;
    EXPECT_NEAR(at(u, v)[1], y, 1e-9) << u << v;
  }
}

TEST(ImportPictures, WhatIsNoPictureIsToldAndItsBaseColourStandsForIt) {
  const struct {
    nlohmann::json image;
    const char* said;
  } cases[] = {{{{"uri", "gone.png"}}, "times a texture (file \"gone.png\""},
               {{{"uri", "../x.png"}}, "times a texture (file \"../x.png\""},
               {{{"uri", "http://x/y.png"}}, "names the image \"http://x/y.png\""},
               {{{"uri", "data:image/png;base64,?"}}, "data URI that is not base64"},
               {{{"uri", "text.png"}}, "it is neither a PNG nor a JPEG"},
               {{{"uri", "cut.jpg"}}, "it can't be read as a JPEG"},
               {nlohmann::json::object(), "has neither a URI nor a view"}};
  for (const auto& one : cases) {
    const TemporaryFolder folder;
    folder.write("text.png", "no picture");
    folder.write("cut.jpg", "\xFF\xD8\xFF\xE0 and no more");
    const ImportedScene scene =
        imported_of(textured({{"pbrMetallicRoughness", base_color}}, one.image), folder);
    EXPECT_NE(sentence(scene).find(one.said), std::string::npos) << sentence(scene);
    EXPECT_FALSE(scene.message.material(0).has_texture());
    EXPECT_TRUE(scene.message.material(0).has_diffuse());
    EXPECT_TRUE(scene.files.empty());
  }
  const TemporaryFolder folder;
  folder.write("x.png", grey_png);
  EXPECT_NE(sentence(imported_of(textured({{"normalTexture", {{"index", 0}}}}, {{"uri", "x.png"}}),
                                 folder))
                .find("its normalTexture does not count (it has no R, G and B)"),
            std::string::npos);
}

TEST(ImportPictures, OneThatASceneCannotHaveIsToldAndTheSceneRenders) {
  const auto with = [](const char* name, const nlohmann::json& value) {
    nlohmann::json color = base_color;
    color["baseColorTexture"][name] = value;
    return nlohmann::json{{"pbrMetallicRoughness", color}};
  };
  const nlohmann::json huge = {{"KHR_texture_transform", {{"scale", {1e30, 1}}}}};
  nlohmann::json bland = with("index", 0);
  bland["alphaMode"] = "BLAND";
  GltfText bare = textured(with("index", 0), {{"uri", "x.png"}});
  bare.json["meshes"][0]["primitives"][0]["attributes"].erase("TEXCOORD_0");
  GltfText partly = textured(with("index", 0), {{"uri", "x.png"}});
  nlohmann::json without = partly.json["meshes"][0]["primitives"][0];
  without["attributes"].erase("TEXCOORD_0");
  partly.json["meshes"][0]["primitives"].push_back(without);
  const struct {
    GltfText text;
    bool textured;
    const char* said;
  } cases[] = {
      {textured(with("extensions", huge), {{"uri", "x.png"}}), false, "times a texture (texture."},
      {textured(with("texCoord", 1), {{"uri", "x.png"}}), false, "it lies by TEXCOORD_1"},
      {textured(bland, {{"uri", "x.png"}}), true, "its alphaMode \"BLAND\" is none"},
      {bare, false, "not all of its surface has UVs"},
      {partly, false, "not all of its surface has UVs"}};
  for (const auto& one : cases) {
    const TemporaryFolder folder;
    folder.write("x.png", rgb_png);
    const ImportedScene scene = imported_of(one.text, folder);
    EXPECT_NE(sentence(scene).find(one.said), std::string::npos) << sentence(scene);
    EXPECT_EQ(scene.message.material(0).has_texture(), one.textured);
    EXPECT_NE(scene.message.material(0).has_diffuse(), one.textured);
  }
}

TEST(ImportPictures, ViewsThatOverlapDoNotFillADisk) {
  // A hundred images of the same large bytes.
  GltfText text = textured({{"pbrMetallicRoughness", base_color}}, {{"bufferView", 2}});
  std::vector<std::uint8_t> large(rgb_png.begin(), rgb_png.end());
  large.resize(100'000);
  text.accessor(large, "SCALAR", 1);
  for (int i = 1; i < 100; ++i) {
    text.json["images"].push_back({{"bufferView", 2}});
    text.json["textures"].push_back({{"source", i}});
    nlohmann::json material = {{"name", "m" + std::to_string(i)}};
    material["pbrMetallicRoughness"]["baseColorTexture"]["index"] = i;
    text.json["materials"].push_back(material);
    auto primitive = text.json["meshes"][0]["primitives"][0];
    primitive["material"] = i;
    text.json["meshes"][0]["primitives"].push_back(primitive);
  }
  const TemporaryFolder folder;
  const ImportedScene scene = imported_of(text, folder);
  std::size_t bytes = 0;
  for (const NewFile& file : scene.files) bytes += file.bytes.size();
  EXPECT_LT(bytes, 400'000u);
  EXPECT_GE(scene.files.size(), 1u);
}

}  // namespace
}  // namespace metamer::client
