#include "common/mesh/gltf/gltf_mesh.h"

#include <cmath>
#include <numbers>

#include "gltf_text.h"

namespace metamer {
namespace {

Double3 position_of(const MeshFile& file, std::size_t i) {
  return file.positions_f64.empty()
             ? Double3{file.positions[i][0], file.positions[i][1], file.positions[i][2]}
             : file.positions_f64[i];
}

TEST(GltfMesh, AGltfAndAGlbAreReadAlike) {
  const GltfText text = triangle();
  const auto gltf = gltf_of(text);
  const auto glb = gltf_of(text.glb());
  ASSERT_TRUE(gltf && glb) << problem_of(gltf) << problem_of(glb);
  EXPECT_EQ(gltf->positions, glb->positions);
  EXPECT_EQ(gltf->triangles, glb->triangles);
  EXPECT_EQ(gltf->triangles, (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(GltfMesh, NodesMoveTurnAndMirror) {
  struct Case {
    nlohmann::json node;
    std::array<Double3, 3> expected;
  };
  const double h = std::sqrt(0.5);
  const std::vector<Case> cases = {
      {{{"translation", {1, 2, 3}}}, {{{1, 2, 3}, {2, 2, 3}, {1, 3, 3}}}},
      {{{"scale", {2, 3, 4}}}, {{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}}}},
      // A quarter turn about z: x to y, y to -x.
      {{{"rotation", {0, 0, h, h}}}, {{{0, 0, 0}, {0, 1, 0}, {-1, 0, 0}}}},
      {{{"translation", {5, 0, 0}}, {"rotation", {0, 0, h, h}}, {"scale", {2, 1, 1}}},
       {{{5, 0, 0}, {5, 2, 0}, {4, 0, 0}}}},
      {{{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1}}},
       {{{7, 8, 9}, {8, 8, 9}, {7, 9, 9}}}},
  };
  for (const Case& one : cases) {
    GltfText text = triangle();
    text.json["nodes"][0].update(one.node);
    const auto file = gltf_of(text);
    ASSERT_TRUE(file) << problem_of(file);
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(position_of(*file, i)[k], one.expected[i][k], 1e-6) << one.node;
  }
  GltfText mirrored = triangle();
  mirrored.json["nodes"][0]["scale"] = {-1, 1, 1};
  EXPECT_EQ(gltf_of(mirrored)->triangles, (std::vector<Triangle>{{0, 2, 1}})) << "the same side";
}

TEST(GltfMesh, ChildrenStandOnTheirParents) {
  GltfText text = triangle();
  text.json["nodes"] = {{{"children", {1}}, {"translation", {10, 0, 0}}},
                        {{"children", {2}}, {"scale", {2, 2, 2}}},
                        {{"mesh", 0}, {"translation", {0, 1, 0}}}};
  const auto file = gltf_of(text);
  ASSERT_TRUE(file) << problem_of(file);
  EXPECT_EQ(position_of(*file, 1), (Double3{12, 2, 0}));
}

TEST(GltfMesh, AHundredThousandNodesInARowAreWalked) {
  GltfText text = triangle();
  text.json["nodes"] = nlohmann::json::array();
  constexpr int count = 100'000;
  for (int i = 0; i + 1 < count; ++i) text.json["nodes"].push_back({{"children", {i + 1}}});
  text.json["nodes"].push_back({{"mesh", 0}});
  const auto file = gltf_of(text);
  ASSERT_TRUE(file) << problem_of(file);
  EXPECT_EQ(file->triangles.size(), 1u);
}

TEST(GltfMesh, WithoutAScenesListEachNodeThatIsNoChildIsARoot) {
  GltfText text = triangle();
  text.json.erase("scenes");
  text.json.erase("scene");
  text.json["nodes"] = {{{"mesh", 0}}, {{"children", {2}}}, {{"mesh", 0}}};
  EXPECT_EQ(gltf_of(text)->triangles.size(), 2u);
}

TEST(GltfMesh, NumbersOfEveryTypeAreWhatTheFormatSays) {
  const auto x_of = [](auto numbers, bool normalized) {
    GltfText text;
    const int positions = text.accessor(numbers, "VEC3", 3, normalized);
    text.node_of({{"attributes", {{"POSITION", positions}}}});
    const auto file = gltf_of(text);
    EXPECT_TRUE(file) << problem_of(file);
    return file ? std::array{position_of(*file, 1)[0], position_of(*file, 2)[1]}
                : std::array<double, 2>{};
  };
  using Pair = std::array<double, 2>;
  EXPECT_EQ(x_of(std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, 0, -128, 0}, true), (Pair{1, -1}));
  EXPECT_EQ(x_of(std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, 0, -128, 0}, false),
            (Pair{127, -128}));
  EXPECT_EQ(x_of(std::vector<std::uint8_t>{0, 0, 0, 255, 0, 0, 0, 51, 0}, true),
            (Pair{1, static_cast<float>(0.2)}));
  EXPECT_EQ(x_of(std::vector<std::int16_t>{0, 0, 0, 32767, 0, 0, 0, -32767, 0}, true),
            (Pair{1, -1}));
  EXPECT_EQ(x_of(std::vector<std::uint16_t>{0, 0, 0, 65535, 0, 0, 0, 7, 0}, false),
            (Pair{65535, 7}));
}

TEST(GltfMesh, IndicesOfEveryTypeStripsAndFansMakeTriangles) {
  const std::vector<float> square = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0};
  const auto triangles = [&](auto indices, int mode) {
    GltfText text;
    const int positions = text.vec3(square), list = text.accessor(indices, "SCALAR", 1);
    text.node_of({{"attributes", {{"POSITION", positions}}}, {"indices", list}, {"mode", mode}});
    const auto file = gltf_of(text);
    EXPECT_TRUE(file) << problem_of(file);
    return file ? file->triangles : std::vector<Triangle>();
  };
  using List = std::vector<Triangle>;
  EXPECT_EQ(triangles(std::vector<std::uint8_t>{0, 1, 2, 2, 1, 3}, 4),
            (List{{0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(triangles(std::vector<std::uint16_t>{0, 1, 2, 3}, 5), (List{{0, 1, 2}, {2, 1, 3}}));
  EXPECT_EQ(triangles(std::vector<std::uint32_t>{0, 1, 3, 2}, 6), (List{{1, 3, 0}, {3, 2, 0}}));
  // A strip goes on over triangles without area.
  EXPECT_EQ(triangles(std::vector<std::uint16_t>{0, 1, 2, 2, 3, 3, 1}, 5).size(), 1u);
}

TEST(GltfMesh, SparseElementsLieOverTheOthers) {
  for (const bool dense : {true, false}) {
    GltfText text;
    const int positions = text.vec3(dense ? std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 9, 9, 9}
                                          : std::vector<float>(12));
    const int places = text.accessor(std::vector<std::uint16_t>{1, 3}, "SCALAR", 1);
    const int values = text.vec3({5, 0, 0, 0, 7, 0});
    auto& accessor = text.json["accessors"][positions];
    if (!dense) accessor.erase("bufferView");
    accessor["sparse"] = {{"count", 2},
                          {"indices", {{"bufferView", places}, {"componentType", 5123}}},
                          {"values", {{"bufferView", values}}}};
    text.node_of({{"attributes", {{"POSITION", positions}}},
                  {"indices", text.accessor(std::vector<std::uint16_t>{0, 1, 3}, "SCALAR", 1)}});
    const auto file = gltf_of(text);
    ASSERT_TRUE(file) << problem_of(file);
    EXPECT_EQ(position_of(*file, 1), (Double3{5, 0, 0}));
    EXPECT_EQ(position_of(*file, 3), (Double3{0, 7, 0}));
    EXPECT_EQ(position_of(*file, 2), (Double3{0, dense ? 1.0 : 0.0, 0}));
  }
}

TEST(GltfMesh, PiecesBearTheNamesOfNodesAndMaterials) {
  GltfText text;
  const int positions = text.vec3(corners);
  text.json["materials"] = {{{"name", "wool"}}, nlohmann::json::object()};
  text.node_of({{"attributes", {{"POSITION", positions}}}, {"material", 0}})["name"] = "seat";
  text.node_of({{"attributes", {{"POSITION", positions}}}, {"material", 1}});
  text.node_of({{"attributes", {{"POSITION", positions}}}});
  text.json["meshes"][2]["name"] = "leg";
  text.json["scenes"][0]["nodes"] = {0, 1, 2};
  const auto file = gltf_of(text);
  ASSERT_TRUE(file) << problem_of(file);
  std::vector<std::string> names;
  for (const MeshPiece& piece : file->pieces) names.push_back(piece.object + "/" + piece.material);
  EXPECT_EQ(names, (std::vector<std::string>{"seat/wool", "node_1/material_1", "leg/"}));
  EXPECT_EQ(used(file, {"wool", {}, false}).triangles.size(), 1u);
}

TEST(GltfMesh, MaterialsOfOneNameAreToldApartAndNamesStayOnTheirLine) {
  GltfText text;
  const int positions = text.vec3(corners);
  text.json["materials"] = {{{"name", "red"}}, {{"name", "red"}}, {{"name", "a\nb\x1b"}}};
  text.node_of({{"attributes", {{"POSITION", positions}}}, {"material", 0}});
  for (const int material : {1, 2})
    text.json["meshes"][0]["primitives"].push_back(
        {{"attributes", {{"POSITION", positions}}}, {"material", material}});
  text.json["nodes"][0]["name"] = "x\ty";
  const auto file = gltf_of(text);
  ASSERT_TRUE(file) << problem_of(file);
  ASSERT_EQ(file->pieces.size(), 3u);
  EXPECT_EQ(file->pieces[1].material, "red 2");
  EXPECT_EQ(file->pieces[2].material, "a_b_");
  EXPECT_EQ(file->pieces[2].object, "x_y");
}

TEST(GltfMesh, ANodeFarOutKeepsItsFinePlaces) {
  GltfText text;
  text.node_of({{"attributes", {{"POSITION", text.vec3({0, 0, 0, 0.001f, 0, 0, 0, 0.001f, 0})}}}});
  text.json["nodes"][0]["translation"] = {5.4e6, 0, 0};
  const auto file = gltf_of(text);
  ASSERT_TRUE(file) << problem_of(file);
  ASSERT_EQ(file->positions_f64.size(), 3u);
  EXPECT_NEAR(file->positions_f64[1][0] - 5.4e6, 0.001, 1e-9);
}

TEST(GltfMesh, VertexColoursAreLeftOutWithANoteThatNamesTheirObjects) {
  GltfText text;
  const int positions = text.vec3(corners);
  const nlohmann::json plain = {{"attributes", {{"POSITION", positions}}}};
  const nlohmann::json colored = {
      {"attributes", {{"POSITION", positions}, {"COLOR_0", positions}}}};
  nlohmann::json nodes = nlohmann::json::array();
  for (const auto& [name, primitive] :
       {std::pair{"plain", plain}, std::pair{"cap", colored}, std::pair{"stem", colored}}) {
    text.node_of(primitive)["name"] = name;
    nodes.push_back(nodes.size());
  }
  text.json["scenes"][0]["nodes"] = nodes;
  const auto file = gltf_of(text);
  ASSERT_TRUE(file) << problem_of(file);
  EXPECT_EQ(file->notes, std::vector<std::string>{
                             "vertex colours (COLOR_0) of \"cap\", \"stem\" were left out"});
}

TEST(GltfMesh, PointsAndLinesAreSkippedAndCounted) {
  GltfText text = triangle();
  text.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 0}});
  text.json["meshes"][0]["primitives"].push_back({{"attributes", {{"POSITION", 0}}}, {"mode", 3}});
  const auto file = gltf_of(text);
  ASSERT_TRUE(file) << problem_of(file);
  EXPECT_EQ(file->skipped_faces, 5u);
  EXPECT_EQ(file->triangles.size(), 1u);
}

TEST(GltfMesh, WithAndWithoutNormalsInOneFileEachIsAsItSays) {
  GltfText text;
  // Two faces of a box that share an edge, by shared vertices and without normals; and a triangle
  // with.
  const int edge = text.vec3({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1});
  const int indices = text.accessor(std::vector<std::uint16_t>{0, 1, 2, 0, 3, 1}, "SCALAR", 1);
  const int positions = text.vec3(corners), normals = text.vec3({0, 0, -1, 0, 0, -1, 0, 0, -1});
  text.node_of({{"attributes", {{"POSITION", edge}}}, {"indices", indices}});
  text.json["meshes"][0]["primitives"].push_back(
      {{"attributes", {{"POSITION", positions}, {"NORMAL", normals}}}});
  const auto file = gltf_of(text);
  ASSERT_TRUE(file) << problem_of(file);
  const TriangleMesh mesh = used(file);
  ASSERT_EQ(mesh.triangles.size(), 3u);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(mesh.normals[mesh.triangles[0][c]][2], 1, 1e-6);
    EXPECT_NEAR(mesh.normals[mesh.triangles[1][c]][1], 1, 1e-6);
    EXPECT_NEAR(mesh.normals[mesh.triangles[2][c]][2], -1, 1e-6);
  }
}

}  // namespace
}  // namespace metamer
