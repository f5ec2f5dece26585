// What public reports have found wrong in readers of glTF: the files' meshes are those of the files
// that say the same plainly.
#include <algorithm>
#include <filesystem>

#include "gltf_text.h"

namespace metamer {
namespace {

/// The corners of a mesh's triangles with their normals, in the triangles' order.
std::vector<std::array<double, 6>> corners_and_normals(const TriangleMesh& mesh) {
  std::vector<std::array<double, 6>> list;
  for (const Triangle& triangle : mesh.triangles)
    for (const std::uint32_t vertex : triangle) {
      const Double3 p = mesh.positions[vertex];
      const Float3& n = mesh.normals[vertex];
      list.push_back({p[0], p[1], p[2], n[0], n[1], n[2]});
    }
  return list;
}

void expect_same(const TriangleMesh& one, const TriangleMesh& other, double place, double normal) {
  const auto a = corners_and_normals(one), b = corners_and_normals(other);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t k = 0; k < 6; ++k) EXPECT_NEAR(a[i][k], b[i][k], k < 3 ? place : normal) << i;
}

TEST(GltfCases, QuantisedNumbersAreThePlainOnes) {
  expect_same(used(gltf_case("quant_u16.gltf")), used(gltf_case("plain.gltf")), 1e-4, 5e-3);
}

TEST(GltfCases, AMorphTargetCountsByItsDefaultWeight) {
  expect_same(used(gltf_case("morph1.gltf")), used(gltf_case("morph1_ref.gltf")), 1e-6, 1e-6);
}

TEST(GltfCases, ATargetOfZerosIsLegal) {
  expect_same(used(gltf_case("morph_zero.gltf")), used(gltf_case("plain.gltf")), 0, 0);
}

TEST(GltfCases, WithoutNormalsABoxIsFlat) {
  expect_same(used(gltf_case("nonormal.gltf")), used(gltf_case("plain.gltf")), 0, 1e-6);
}

TEST(GltfCases, WithoutNormalsABallIsRound) {
  const TriangleMesh with = used(ply_of(case_text("with.ply")));
  const TriangleMesh without = used(gltf_case("without.gltf"));
  ASSERT_EQ(with.triangles.size(), without.triangles.size());
  for (std::size_t i = 0; i < with.triangles.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_LE(degrees_between(with.normals[with.triangles[i][c]],
                                without.normals[without.triangles[i][c]]),
                1.4);
  // And flat where it is asked for, as the format has it.
  const TriangleMesh flat = used(gltf_case("without.gltf"), {{}, 0, false});
  for (const Triangle& t : flat.triangles) {
    EXPECT_EQ(flat.normals[t[0]], flat.normals[t[1]]);
    EXPECT_EQ(flat.normals[t[0]], flat.normals[t[2]]);
  }
}

TEST(GltfCases, InstancesAreDone) {
  const auto file = gltf_case("instancing.gltf");
  ASSERT_TRUE(file) << problem_of(file);
  EXPECT_EQ(file->triangles.size(), 3 * 12u);
}

TEST(GltfCases, ARequiredExtensionThatIsNotReadIsNamed) {
  EXPECT_EQ(problem_of(gltf_case("req_unknown.gltf")),
            "error: requires an extension that is not read: \"ACME_future_geometry\"");
}

TEST(GltfCases, FilesThatEndedAReaderHaveAMeshOrAMessage) {
  int count = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(METAMER_TEST_DATA "/common/mesh/cases")) {
    const std::string name = entry.path().filename();
    if (!name.starts_with("crash") || name.ends_with(".ply")) continue;
    const auto file = gltf_case(name);
    if (file)
      EXPECT_FALSE(used(file).triangles.empty()) << name;
    else
      EXPECT_FALSE(file.error().message.empty()) << name;
    ++count;
  }
  EXPECT_EQ(count, 9);
}

}  // namespace
}  // namespace metamer
