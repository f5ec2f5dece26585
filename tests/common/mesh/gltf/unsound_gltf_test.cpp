// Files that are not sound glTF, or larger than they may be: each is refused with its place.
#include <cmath>
#include <functional>

#include "common/mesh/gltf/gltf_mesh.h"
#include "gltf_text.h"

namespace metamer {
namespace {

TEST(UnsoundGltf, AGraphThatIsNoTreeIsToldAndEnds) {
  for (const nlohmann::json& nodes :
       std::vector<nlohmann::json>{{{{"children", {0}}, {"mesh", 0}}},
                                   {{{"children", {1}}}, {{"children", {0}}, {"mesh", 0}}},
                                   {{{"children", {1, 2}}}, {{"children", {2}}}, {{"mesh", 0}}}}) {
    GltfText text = triangle();
    text.json["nodes"] = nodes;
    EXPECT_NE(problem_of(gltf_of(text)).find("is met twice"), std::string::npos) << nodes;
  }
}

TEST(UnsoundGltf, AFileThatIsNotSoundHasAMessageThatNamesThePlace) {
  struct Case {
    std::function<void(nlohmann::json&)> change;
    std::string message;
  };
  const std::vector<Case> cases = {
      {[](auto& j) { j["accessors"][0]["count"] = 4; },
       "bufferViews[0] has 36 bytes; 48 are wanted from 0 on"},
      {[](auto& j) { j["accessors"][0]["count"] = -1; },
       "accessors[0].count must be a whole number"},
      {[](auto& j) { j["accessors"][0]["count"] = 1e18; },
       "accessors[0].count must be a whole number"},
      {[](auto& j) { j["accessors"][0]["byteOffset"] = 1u << 30; }, "bufferViews[0] has 36 bytes"},
      {[](auto& j) { j["accessors"][0]["componentType"] = 7; },
       "accessors[0].componentType is no type of numbers"},
      {[](auto& j) { j["accessors"][0]["type"] = "MAT4"; },
       "accessors[0].type is not what meshes[0].primitives[0].attributes.POSITION needs"},
      {[](auto& j) { j["accessors"][0]["bufferView"] = 99; },
       "accessors[0].bufferView must be a whole number from 0 to 1"},
      {[](auto& j) {
         j["bufferViews"][0]["byteLength"] = 1u << 30;
         j["accessors"][0]["count"] = 5;
       },
       "bufferViews[0].buffer has 42 bytes; 60 are wanted from 0 on"},
      {[](auto& j) { j["bufferViews"][0]["byteStride"] = 4; },
       "bufferViews[0].byteStride is shorter than an element"},
      {[](auto& j) { j["bufferViews"][0]["buffer"] = 3; }, "bufferViews[0].buffer must be"},
      {[](auto& j) { j["meshes"][0]["primitives"][0]["mode"] = 9; },
       "meshes[0].primitives[0].mode must be a whole number from 0 to 6"},
      {[](auto& j) { j["meshes"] = 5; }, "meshes is not a list"},
      {[](auto& j) { j["nodes"][0]["mesh"] = "a"; }, "nodes[0].mesh must be"},
      {[](auto& j) {
         j["nodes"][0]["matrix"] = {1, 2};
       },
       "nodes[0].matrix must have 16 numbers"},
      {[](auto& j) {
         j["nodes"][0]["translation"] = {1, 2, "x"};
       },
       "nodes[0].translation[2] must be a number"},
      {[](auto& j) { j["scenes"][0]["nodes"] = {7}; }, "scenes[0].nodes[0] must be"},
  };
  for (const Case& one : cases) {
    GltfText text = triangle();
    one.change(text.json);
    const std::string said = problem_of(gltf_of(text));
    EXPECT_NE(said.find("is not sound glTF: "), std::string::npos) << one.message << said;
    EXPECT_NE(said.find(one.message), std::string::npos) << one.message << said;
  }
}

TEST(UnsoundGltf, VerticesAndIndicesOutOfBoundsAreNamed) {
  GltfText text;
  text.node_of({{"attributes", {{"POSITION", text.vec3({0, 0, 0, 1, 0, 0, 0, NAN, 0})}}}});
  EXPECT_EQ(problem_of(gltf_of(text)), "error: vertex 2 is not finite or too far out");
  for (const float bad : {NAN, INFINITY, -INFINITY}) {
    GltfText placed;
    const int at = placed.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0});
    placed.node_of(
        {{"attributes",
          {{"POSITION", at},
           {"TEXCOORD_0", placed.accessor(std::vector<float>{0, 0, 1, bad, 1, 1}, "VEC2", 2)}}}});
    EXPECT_EQ(problem_of(gltf_of(placed)),
              "error: the UV of vertex 1 is not finite or too far out");
  }
  GltfText far = triangle();
  far.json["nodes"][0]["scale"] = {1e20, 1, 1};
  EXPECT_EQ(problem_of(gltf_of(far)), "error: vertex 1 is not finite or too far out");
  GltfText wild;
  const int positions = wild.vec3(corners);
  wild.node_of(
      {{"attributes", {{"POSITION", positions}}},
       {"indices", wild.accessor(std::vector<std::uint32_t>{0, 1, 4000000000}, "SCALAR", 1)}});
  EXPECT_EQ(problem_of(gltf_of(wild)), "error: triangle 0 names vertex 4000000000; there are 3");
}

TEST(UnsoundGltf, AGlbThatIsCutShortHasItsMessageAtEveryLength) {
  const std::string whole = triangle().glb();
  ASSERT_TRUE(gltf_of(whole));
  for (std::size_t length = 0; length < whole.size(); ++length)
    EXPECT_FALSE(gltf_of(whole.substr(0, length))) << length;
  EXPECT_NE(problem_of(gltf_of(whole.substr(0, 100))).find("is cut short"), std::string::npos);
}

TEST(UnsoundGltf, ElementsWithoutBytesAreAsManyAsAFileOfItsSizeMayName) {
  const auto many = [&](std::size_t count) {
    GltfText one = triangle();
    // Zeros need no bytes: a few hundred bytes of JSON name any number of instances.
    one.json["accessors"].push_back({{"componentType", 5126}, {"count", count}, {"type", "VEC3"}});
    one.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
        one.json["accessors"].size() - 1;
    return gltf_of(one);
  };
  EXPECT_EQ(many(500)->triangles.size(), 500u);
  for (const std::size_t count : {10'000u, 40'000'000u, 149'000'000u})
    EXPECT_EQ(problem_of(many(count)),
              "error: is not sound glTF: accessors[2].count is more than a file of its size may "
              "name without a bufferView");
  // The same for places and indices.
  for (const std::string name : {"POSITION", "indices"}) {
    GltfText zeros = triangle();
    auto& primitive = zeros.json["meshes"][0]["primitives"][0];
    zeros.json["accessors"].push_back({{"componentType", name == "indices" ? 5125 : 5126},
                                       {"count", 140'000'000},
                                       {"type", name == "indices" ? "SCALAR" : "VEC3"}});
    (name == "indices" ? primitive["indices"] : primitive["attributes"]["POSITION"]) = 2;
    EXPECT_FALSE(gltf_of(zeros)) << name;
  }
}

TEST(UnsoundGltf, InstancesOfLargeMeshesAreCountedBeforeTheyAreMade) {
  GltfText text = triangle();
  const std::vector<std::uint8_t> many(3'000'000);
  text.json["meshes"][0]["primitives"][0]["indices"] = text.accessor(many, "SCALAR", 1);
  text.json["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"]["TRANSLATION"] =
      text.vec3(std::vector<float>(3 * 100));
  EXPECT_NE(problem_of(gltf_of(text)).find("holds more than 50000000 faces"), std::string::npos)
      << problem_of(gltf_of(text));
}

TEST(UnsoundGltf, AFileOfAnotherVersionOrThatNeedsOneIsRefusedByItsName) {
  // glTF 2.0, 3.2: minVersion says what is needed to load the file, else version does.
  const auto said = [](const nlohmann::json& asset) {
    GltfText text = triangle();
    text.json["asset"] = asset;
    return problem_of(gltf_of(text));
  };
  for (const char* version : {"2.0", "2.1", "2.17"})
    EXPECT_TRUE(gltf_of([&] {
      GltfText text = triangle();
      text.json["asset"] = {{"version", version}, {"minVersion", "2.0"}};
      return text;
    }()))
        << version;
  for (const char* version : {"1.0", "3.0", "20.0", "2x", "2.", "two", ""})
    EXPECT_NE(said({{"version", version}}).find("is glTF \"" + std::string(version) + "\""),
              std::string::npos)
        << version;
  for (const char* version : {"2.1", "2.10", "3.0", "20.0", "2", "two"})
    EXPECT_NE(said({{"version", "2.1"}, {"minVersion", version}})
                  .find("needs glTF \"" + std::string(version) + "\" (asset.minVersion)"),
              std::string::npos)
        << version;
}

}  // namespace
}  // namespace metamer
