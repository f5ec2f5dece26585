#include "server/import/transfer.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmath>

namespace metamer::import {
namespace {

TriangleMesh square() {
  TriangleMesh mesh;
  mesh.positions = Array(std::vector<Float3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  mesh.normals = std::vector<Float3>(4, {0, 0, 1});
  mesh.triangles = std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// What comes of the memory of a mesh.
std::optional<std::vector<TriangleMesh>> handed_over(TriangleMesh mesh) {
  v1::MeshImported::Meshes description;
  const auto memory = put_meshes({std::move(mesh)}, description);
  return memory ? take_meshes(*memory, description) : std::nullopt;
}

TEST(Transfer, MeshesAreHandedOver) {
  const auto meshes = handed_over(square());
  ASSERT_TRUE(meshes);
  EXPECT_EQ(meshes->front().positions.size(), 4u);
  EXPECT_EQ(meshes->front().triangles[1][2], 3u);
}

TEST(Transfer, AMeshThatARendererCouldNotTakeIsRefused) {
  const auto refused = [](auto change) {
    TriangleMesh mesh = square();
    change(mesh);
    return !handed_over(std::move(mesh));
  };
  using Positions3 = std::vector<Float3>;
  EXPECT_TRUE(refused([](auto& m) { m.triangles = std::vector<Triangle>{{0, 1, 4}}; }));
  EXPECT_TRUE(refused([](auto& m) { m.triangles = {}; }));
  EXPECT_TRUE(refused([](auto& m) { m.normals = Positions3(3); }));
  EXPECT_TRUE(refused([](auto& m) { m.normals = Positions3(4, {NAN, 0, 0}); }));
  EXPECT_TRUE(refused([](auto& m) { m.tangents = Positions3(5); }));
  for (const float bad : {NAN, INFINITY, -INFINITY, 1e16f})
    EXPECT_TRUE(refused([&](auto& m) { m.positions = Array(Positions3(4, {0, bad, 0})); }));
  EXPECT_TRUE(refused([](auto& m) {
    m.positions = Array(std::vector<Double3>(4, {0, 0, std::nan("")}));
  }));
}

TEST(Transfer, MemoryThatIsNotAsItIsDescribedIsRefused) {
  v1::MeshImported::Meshes description;
  const auto memory = put_meshes({square()}, description);
  ASSERT_TRUE(memory && take_meshes(*memory, description));
  for (const std::uint64_t count :
       {std::uint64_t{100}, std::uint64_t{1} << 32, std::uint64_t{1} << 62, ~std::uint64_t{0}}) {
    v1::MeshImported::Meshes lie = description;
    lie.mutable_arrays(0)->set_triangles(count);
    EXPECT_FALSE(take_meshes(*memory, lie)) << count;
    lie = description;
    lie.mutable_arrays(0)->set_positions_f64(count);
    EXPECT_FALSE(take_meshes(*memory, lie)) << count;
  }
  v1::MeshImported::Meshes twice = description;
  *twice.add_arrays() = description.arrays(0);
  EXPECT_FALSE(take_meshes(*memory, twice));
}

TEST(Transfer, MemoryThatCanStillChangeIsRefused) {
  v1::MeshImported::Meshes description;
  const auto memory = put_meshes({square()}, description);
  ASSERT_TRUE(memory);
  EXPECT_EQ(ftruncate(memory->get(), 10), -1);
  EXPECT_EQ(mmap(nullptr, 64, PROT_READ | PROT_WRITE, MAP_SHARED, memory->get(), 0), MAP_FAILED);

  const Descriptor open(memfd_create("open", MFD_ALLOW_SEALING));
  ASSERT_EQ(ftruncate(open.get(), 4096), 0);
  EXPECT_FALSE(take_meshes(open, description));
  const Descriptor file(::open("/dev/zero", O_RDONLY));
  EXPECT_FALSE(take_meshes(file, description));
  EXPECT_FALSE(take_meshes(Descriptor(), description));
}

}  // namespace
}  // namespace metamer::import
