#include "common/mesh/smooth_normals.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "../mesh_text.h"

namespace metamer {
namespace {

TEST(SmoothNormals, OfASphereWithoutThemAreTheFilesOwn) {
  const TriangleMesh with = used(ply_of(case_text("with.ply")));
  const TriangleMesh without = used(ply_of(case_text("without.ply")));
  ASSERT_EQ(with.normals.size(), without.normals.size());
  for (std::size_t i = 0; i < with.normals.size(); ++i)
    EXPECT_LE(degrees_between(with.normals[i], without.normals[i]), 1.4) << i;
}

TEST(SmoothNormals, DegenerateFacesChangeNothing) {
  const TriangleMesh good = used(ply_of(case_text("good.ply")));
  for (const char* name : {"degen.ply", "zero_ascii.ply"}) {
    const TriangleMesh other = used(ply_of(case_text(name)));
    EXPECT_EQ(corners_of(other), corners_of(good)) << name;
    ASSERT_EQ(other.normals.size(), good.normals.size());
    for (std::size_t i = 0; i < good.normals.size(); ++i)
      EXPECT_EQ(other.normals[i], good.normals[i]);
    EXPECT_EQ(other.skipped_faces, 1u) << name;
  }
}

/// The mesh of a file without normals.
MeshFile sphere() {
  auto file = ply_of(case_text("without.ply"));
  return file.value_or(MeshFile());
}

TEST(SmoothNormals, DependOnNoOrder) {
  const MeshFile file = sphere();
  MeshFile plain = file;
  smooth_normals(plain);
  std::mt19937 random(1);
  for (int turn = 0; turn < 20; ++turn) {
    // Number vertices anew, order triangles anew, and begin each with another corner.
    std::vector<std::uint32_t> numbers(file.positions.size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    std::shuffle(numbers.begin(), numbers.end(), random);
    MeshFile other = file;
    for (std::size_t i = 0; i < numbers.size(); ++i)
      other.positions[numbers[i]] = file.positions[i];
    for (Triangle& t : other.triangles) {
      for (std::uint32_t& vertex : t) vertex = numbers[vertex];
      std::rotate(t.begin(), t.begin() + random() % 3, t.end());
    }
    std::shuffle(other.triangles.begin(), other.triangles.end(), random);
    smooth_normals(other);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k)
        ASSERT_NEAR(other.normals[numbers[i]][k], plain.normals[i][k], 1e-6);
  }
}

TEST(SmoothNormals, VerticesAtOnePlaceAreOne) {
  const MeshFile file = sphere();
  MeshFile plain = file, soup = file;
  smooth_normals(plain);
  soup.positions.clear();
  for (Triangle& t : soup.triangles)
    for (std::uint32_t& vertex : t) {
      soup.positions.push_back(file.positions[vertex]);
      if (soup.positions.back()[0] == 0)
        soup.positions.back()[0] = soup.positions.size() % 2 ? 0.f : -0.f;
      vertex = static_cast<std::uint32_t>(soup.positions.size() - 1);
    }
  smooth_normals(soup);
  for (std::size_t i = 0; i < file.triangles.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(soup.normals[3 * i + k], plain.normals[file.triangles[i][k]]);
}

TEST(SmoothNormals, NeedlesOnAnEdgeChangeNothing) {
  // Triangles that are a line but for rounding, and some whose corners are at one place.
  MeshFile plain = sphere(), other = plain;
  smooth_normals(plain);
  const std::size_t count = other.positions.size();
  const std::vector<Triangle> triangles = other.triangles;
  for (const Triangle& t : triangles) {
    const Float3 a = other.positions[t[0]], b = other.positions[t[1]];
    const auto middle = static_cast<std::uint32_t>(other.positions.size());
    other.positions.push_back(
        {a[0] * 0.3f + b[0] * 0.7f, a[1] * 0.3f + b[1] * 0.7f, a[2] * 0.3f + b[2] * 0.7f});
    other.positions.push_back(a);
    other.triangles.insert(other.triangles.begin(), {t[0], middle, t[1]});
    other.triangles.push_back({t[0], middle + 1, t[2]});
  }
  smooth_normals(other);
  for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(other.normals[i], plain.normals[i]) << i;
}

TEST(SmoothNormals, AreWeightedByAngle) {
  // A cube's corner, however its faces are cut into triangles: the diagonal (Thürmer & Wüthrich).
  for (const std::string faces :
       {"f 1 2 3\nf 1 3 4\nf 1 4 5\nf 1 5 6\nf 1 6 7\nf 1 7 2\n",
        "f 1 2 3 4\nf 1 4 5 6\nf 7 2 1 6\n", "f 1 2 4\nf 1 4 6\nf 1 6 2\n"}) {
    const auto file =
        obj_of("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 1 1\nv 0 0 1\nv 1 0 1\n" + faces);
    const Float3 normal = used(file).normals[0];
    for (const float part : normal) EXPECT_NEAR(part, 1 / std::sqrt(3.0), 1e-7) << faces;
  }
}

TEST(SmoothNormals, OfALargeMeshAreThoseOfTheFormulaItself) {
  // A sheet of 90,000 vertices with triangles of all shapes, which several threads smooth.
  constexpr std::uint32_t side = 300;
  MeshFile file;
  std::mt19937 random(1);
  std::uniform_real_distribution<float> away(-0.45f, 0.45f);
  for (std::uint32_t i = 0; i < side * side; ++i)
    file.positions.push_back({static_cast<float>(i % side) + away(random),
                              static_cast<float>(i / side) + away(random), 3 * away(random)});
  for (std::uint32_t i = 0; i + side < side * side; ++i) {
    if (i % side == side - 1) continue;
    file.triangles.push_back({i, i + 1, i + side + 1});
    file.triangles.push_back({i, i + side + 1, i + side});
  }
  std::shuffle(file.triangles.begin(), file.triangles.end(), random);

  using Vector = std::array<long double, 3>;
  std::vector<Vector> sums(file.positions.size(), Vector{});
  for (const Triangle& t : file.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      Vector a{}, b{}, n{};
      for (std::size_t x = 0; x < 3; ++x) {
        a[x] =
            static_cast<long double>(file.positions[t[(k + 1) % 3]][x]) - file.positions[t[k]][x];
        b[x] =
            static_cast<long double>(file.positions[t[(k + 2) % 3]][x]) - file.positions[t[k]][x];
      }
      for (std::size_t x = 0; x < 3; ++x)
        n[x] = a[(x + 1) % 3] * b[(x + 2) % 3] - a[(x + 2) % 3] * b[(x + 1) % 3];
      const long double size = std::hypot(n[0], n[1], n[2]);
      const long double angle = std::atan2(size, a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
      for (std::size_t x = 0; x < 3; ++x) sums[t[k]][x] += angle * n[x] / size;
    }
  smooth_normals(file);
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const long double length = std::hypot(sums[i][0], sums[i][1], sums[i][2]);
    for (std::size_t x = 0; x < 3; ++x)
      ASSERT_NEAR(file.normals[i][x], static_cast<double>(sums[i][x] / length), 3e-7) << i;
  }
}

TEST(SmoothNormals, AVertexOfDegenerateTrianglesHasNone) {
  MeshFile file;
  file.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}};
  file.triangles = {{0, 1, 2}, {0, 1, 3}};
  smooth_normals(file);
  EXPECT_EQ(file.normals[2], (Float3{0, 0, 0}));
  EXPECT_EQ(file.normals[1], (Float3{0, 0, 1}));
}

TEST(SmoothNormals, AFilesOwnStay) {
  MeshFile file;
  file.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  file.normals = {{0, 1, 0}, {0, 0, 0}, {1, 0, 0}};
  file.triangles = {{0, 1, 2}};
  smooth_normals(file);
  EXPECT_EQ(file.normals, (std::vector<Float3>{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}));
}

}  // namespace
}  // namespace metamer
