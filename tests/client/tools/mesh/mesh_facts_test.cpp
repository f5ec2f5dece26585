// What is told of a mesh file, and by which names its parts are chosen.
#include "client/tools/mesh/mesh_facts.h"

#include <gtest/gtest.h>

namespace metamer::client {
namespace {

using Names = std::pair<std::string, std::string>;

/// A mesh of one triangle for each object and material, in this order.
MeshFile mesh_of(const std::vector<Names>& names) {
  MeshFile mesh;
  mesh.positions = {{-1, 0, 0}, {1, 0, 0}, {0, 2, 5}};
  for (const auto& [object, material] : names) {
    mesh.pieces.push_back({.object = object,
                           .material = material,
                           .first_triangle = mesh.triangles.size(),
                           .triangles = 1});
    mesh.triangles.push_back({0, 1, 2});
  }
  return mesh;
}

TEST(MeshFacts, PartsAreNamedByTheShortestNameThatChoosesThemAlone) {
  const MeshFacts facts = mesh_facts(
      mesh_of(
          {{"seat", "fabric"}, {"leg", "steel"}, {"leg", "paint"}, {"arm", "steel"}, {"back", ""}}),
      "a.glb");
  std::vector<std::string> parts;
  for (const MeshPart& part : facts.parts) parts.push_back(part.part);
  EXPECT_EQ(parts, (std::vector<std::string>{"fabric", "leg/steel", "paint", "arm", "back"}));
}

TEST(MeshFacts, ANameOfAnObjectAndOfAnothersMaterialChoosesNeither) {
  const MeshFacts facts = mesh_facts(mesh_of({{"a", "b"}, {"b", "c"}}), "a.obj");
  EXPECT_EQ(facts.parts[0].part, "a");
  EXPECT_EQ(facts.parts[1].part, "c");
}

TEST(MeshFacts, EachNamedPartIsThePartThatTrianglesOfTakes) {
  const MeshFile mesh = mesh_of({{"a", "b"}, {"b", "c"}, {"a", "c"}, {"a", "b"}, {"a/b", ""}});
  for (const MeshPart& part : mesh_facts(mesh, "a.obj").parts) {
    if (part.part.empty()) continue;
    const auto taken = triangles_of(mesh, {.part = part.part});
    ASSERT_TRUE(taken) << part.part << " " << format(taken.error());
    EXPECT_EQ(taken->triangles.size(), part.triangles) << part.part;
  }
}

TEST(MeshFacts, BoundsAndCountsAreThoseOfTheVertices) {
  const MeshFacts facts = mesh_facts(mesh_of({{"", ""}}), "A.PLY");
  EXPECT_EQ(facts.format, "PLY");
  EXPECT_EQ(facts.low, (Double3{-1, 0, 0}));
  EXPECT_EQ(facts.high, (Double3{1, 2, 5}));
  EXPECT_EQ(facts.normals, 0u);
  EXPECT_EQ(facts.parts[0].part, "");
}

}  // namespace
}  // namespace metamer::client
