#include "common/mesh/polygon.h"

#include <cmath>
#include <numeric>
#include <random>

#include "mesh_text.h"

namespace metamer {
namespace {

using Polygon = std::vector<Double3>;

Double3 area_of(const Double3& a, const Double3& b, const Double3& c) {
  Double3 area;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
    area[k] = ((b[u] - a[u]) * (c[v] - a[v]) - (b[v] - a[v]) * (c[u] - a[u])) / 2;
  }
  return area;
}
double size_of(const Double3& v) { return std::hypot(v[0], v[1], v[2]); }

/// Triangles cover a polygon once where their areas, none of which is turned over, are its own.
void expect_covered(const Polygon& polygon) {
  std::vector<Triangle> triangles;
  triangulate(polygon, triangles);
  ASSERT_EQ(triangles.size(), polygon.size() - 2);
  Double3 area{};
  double sizes = 0;
  for (const Triangle& t : triangles) {
    const Double3 part = area_of(polygon[t[0]], polygon[t[1]], polygon[t[2]]);
    for (std::size_t k = 0; k < 3; ++k) area[k] += part[k];
    sizes += size_of(part);
  }
  Double3 whole{};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Double3 part = area_of(polygon[0], polygon[i], polygon[i + 1]);
    for (std::size_t k = 0; k < 3; ++k) whole[k] += part[k];
  }
  EXPECT_NEAR(size_of(area), size_of(whole), 1e-9 * size_of(whole));
  EXPECT_NEAR(sizes, size_of(whole), 1e-9 * size_of(whole)) << "none is turned over";
}

/// The polygon from each of its corners on, in several planes, both ways round.
void expect_covered_anyhow(Polygon polygon) {
  for (std::size_t turn = 0; turn < polygon.size(); ++turn) {
    std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
    for (const bool backwards : {false, true})
      for (int plane = 0; plane < 4; ++plane) {
        Polygon other = polygon;
        if (backwards) std::reverse(other.begin(), other.end());
        for (Double3& p : other) {
          if (plane == 1) p = {p[2], p[0], p[1]};
          if (plane == 2) p = {p[1], p[2], p[0]};
          if (plane == 3) p = {p[0] + 400000, p[1] + 5000000, 0.5 * p[0] + p[1]};
        }
        expect_covered(other);
      }
  }
}

TEST(Polygon, IsCoveredOnceByItsTriangles) {
  expect_covered_anyhow({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  expect_covered_anyhow({{0, 0, 0}, {2, 0, 0}, {0.5, 0.5, 0}, {0, 2, 0}});  // an arrow's head
  expect_covered_anyhow(
      {{0, 0, 0}, {3, 0, 0}, {3, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}});  // an L
  expect_covered_anyhow({{0, 0, 0},
                         {5, 0, 0},
                         {5, 3, 0},
                         {4, 3, 0},
                         {4, 1, 0},
                         {3, 1, 0},
                         {3, 3, 0},
                         {2, 3, 0},
                         {2, 1, 0},
                         {1, 1, 0},
                         {1, 3, 0},
                         {0, 3, 0}});  // a comb
  Polygon star, spiral;
  for (int i = 0; i < 40; ++i) {
    const double angle = i * M_PI / 20, radius = i % 2 == 0 ? 1 : 0.3;
    star.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
  }
  expect_covered_anyhow(star);
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < 30; ++i) {
      const double angle = (side == 0 ? i : 29 - i) * 0.5;
      const double radius = angle + (side == 0 ? 2.0 : 0.5);
      spiral.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
  expect_covered_anyhow(spiral);
  Polygon coil;  // Of a thousand corners, twenty times round.
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < 500; ++i) {
      const double angle = (side == 0 ? i : 499 - i) * 0.25;
      const double radius = angle + (side == 0 ? 4.0 : 1.0);
      coil.push_back({radius * std::cos(angle), radius * std::sin(angle), 0});
    }
  expect_covered(coil);
}

TEST(Polygon, WithCornersOnASideOrTwiceIsCovered) {
  expect_covered_anyhow({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}, {0, 2, 0}});
  expect_covered_anyhow({{0, 0, 0}, {2, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}, {0, 2, 0}});
  // A square with a square hole, to which a bridge leads.
  expect_covered_anyhow({{0, 0, 0},
                         {3, 0, 0},
                         {3, 3, 0},
                         {0, 3, 0},
                         {0, 0, 0},
                         {1, 1, 0},
                         {1, 2, 0},
                         {2, 2, 0},
                         {2, 1, 0},
                         {1, 1, 0}});
}

TEST(Polygon, AnyCornersEndInAsManyTriangles) {
  std::mt19937 random(1);
  std::vector<Triangle> triangles;
  for (std::size_t count = 3; count < 60; ++count)
    for (const int range : {1, 3, 1000}) {
      Polygon polygon;
      for (std::size_t i = 0; i < count; ++i)
        polygon.push_back({static_cast<double>(random() % static_cast<unsigned>(range)),
                           static_cast<double>(random() % static_cast<unsigned>(range)),
                           static_cast<double>(random() % 2)});
      triangulate(polygon, triangles);
      EXPECT_EQ(triangles.size(), count - 2);
    }
  Polygon large(5000);
  for (Double3& p : large) p = {static_cast<double>(random()), static_cast<double>(random()), 0};
  triangulate(large, triangles);
  EXPECT_EQ(triangles.size(), large.size() - 2);
}

TEST(Polygon, AConcaveFaceOfAFileIsNotCoveredTwice) {
  for (const auto& file :
       {obj_of("v 0 0 0\nv 2 0 0\nv .5 .5 0\nv 0 2 0\nf 1 2 3 4\n"),
        ply_of("ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
               "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
               "end_header\n0 0 0\n2 0 0\n.5 .5 0\n0 2 0\n4 0 1 2 3\n")}) {
    ASSERT_TRUE(file) << problem_of(file);
    EXPECT_EQ(file->triangles, (std::vector<Triangle>{{2, 3, 0}, {2, 0, 1}}));
  }
}

}  // namespace
}  // namespace metamer
