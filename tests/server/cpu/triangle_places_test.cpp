// Where on a triangle the interpolating kinds of shading evaluate the model
// (shaders/surface/places.glsl).

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

#include "metamer/v1/scene.pb.h"
#include "server/cpu/corners.h"
#include "server/cpu/shared_source.h"

namespace metamer::cpu {
namespace {

constexpr std::size_t max_places = 6;

/// A triangle's places, one a lane.
struct TrianglePlaces : shared::Place {
  int count;
};

TrianglePlaces triangle_places(v1::Shading shading, const Corners& corners,
                               const std::array<float, 3>& side) {
  shared::Triangle at;
  for (std::size_t i = 0; i < 3; ++i) {
    at.position[i] = broadcast(corners.position[i]);
    at.normal[i] = broadcast(corners.normal[i]);
    at.tangent[i] = broadcast(corners.tangent[i]);
  }
  at.across = broadcast(corners.across);
  return {shared::place_of(at, broadcast(side), shading, Floats{0, 1, 2, 3, 4, 5}),
          shared::place_count(shading)};
}

/// What the places of a triangle hold, interpolated at barycentric u, v.
float interpolated(v1::Shading shading, const std::array<double, max_places>& values, double u,
                   double v) {
  float sum = 0;
  for (int i = 0; i < shared::place_count(shading); ++i)
    sum += shared::place_weight(shading, i, broadcast(static_cast<float>(u)),
                                broadcast(static_cast<float>(v)))[0] *
           static_cast<float>(values[static_cast<std::size_t>(i)]);
  return sum;
}

/// E[2.3-1] with the coefficients of E[2.3-2] (C as the errata have it); L M N at the corners 0,
/// (x1, y1), (x2, y2), Q R S in the middles of their edges LM, LN, MN.
double by_the_source(const std::array<double, 6>& values, double x1, double y1, double x2,
                     double y2, double x, double y) {
  const auto [L, M, N, Q, R, S] = values;
  const double w1 = x1 * y2, w2 = x2 * y1, w3 = w1 - w2;
  const double T = L + M - 2 * Q, U = L + N - 2 * R, V = L + S - R - Q;
  const double G = 2 * Q - 2 * L - T, H = 2 * R - 2 * L - U;
  const double A = 2 * (T * y2 * y2 + U * y1 * y1 - 2 * V * y1 * y2) / (w3 * w3);
  const double B = 2 * (T * x2 * x2 + U * x1 * x1 - 2 * V * x1 * x2) / (w3 * w3);
  const double C = 4 * (V * (w1 + w2) - U * x1 * y1 - T * x2 * y2) / (w3 * w3);
  const double D = (G * y2 - H * y1) / w3, E = (H * x1 - G * x2) / w3;
  return A * x * x + B * y * y + C * x * y + D * x + E * y + L;
}

TEST(TrianglePlaces, QuadraticReproducesAQuadraticFunctionAndIsTheSourcesFormula) {
  std::mt19937_64 engine(2004);
  std::uniform_real_distribution<double> random(-1, 1);
  for (int round = 0; round < 10'000; ++round) {
    const double x1 = random(engine), y1 = random(engine), x2 = random(engine), y2 = random(engine);
    if (std::abs(x1 * y2 - x2 * y1) < 0.05) continue;
    std::array<double, 6> c;
    for (double& value : c) value = random(engine);
    const auto function = [&](double x, double y) {
      return c[0] * x * x + c[1] * y * y + c[2] * x * y + c[3] * x + c[4] * y + c[5];
    };
    const std::array<double, 6> values = {
        function(0, 0),           function(x1, y1),         function(x2, y2),
        function(x1 / 2, y1 / 2), function(x2 / 2, y2 / 2), function((x1 + x2) / 2, (y1 + y2) / 2)};
    const double u = (random(engine) + 1) / 2, v = (1 - u) * (random(engine) + 1) / 2;
    const double x = u * x1 + v * x2, y = u * y1 + v * y2;
    EXPECT_NEAR(by_the_source(values, x1, y1, x2, y2, x, y), function(x, y), 1e-11);
    EXPECT_NEAR(interpolated(v1::QUADRATIC, values, u, v), function(x, y), 4e-6);
  }
}

TEST(TrianglePlaces, GouraudReproducesALinearFunctionAndConstantAConstant) {
  EXPECT_NEAR(interpolated(v1::GOURAUD, {1, 3, 7}, 0.25, 0.5), 0.25 * 1 + 0.25 * 3 + 0.5 * 7, 1e-6);
  EXPECT_EQ(interpolated(v1::CONSTANT, {5}, 0.3, 0.3), 5);
}

/// A value that depends on all that a place holds, as a model's would.
std::array<double, max_places> seen(const TrianglePlaces& places) {
  std::array<double, max_places> values{};
  for (int i = 0; i < places.count; ++i)
    values[static_cast<std::size_t>(i)] = std::exp(static_cast<double>(places.normal.x[i])) +
                                          places.position.y[i] * places.position.z[i] +
                                          places.normal.z[i] * places.tangent.x[i];
  return values;
}

TEST(TrianglePlaces, NeighboursThatShareVerticesShowNoSeam) {
  std::mt19937 engine(7);
  std::uniform_real_distribution<float> random(-1, 1);
  const auto triple = [&] { return std::array{random(engine), random(engine), random(engine)}; };
  const std::array<float, 3> side = {0, 0, 1};
  for (int round = 0; round < 2000; ++round) {
    // Two triangles on either side of the edge b c, written in different orders.
    std::array<std::array<float, 3>, 4> p, n, t;
    for (std::size_t i = 0; i < 4; ++i) p[i] = triple(), n[i] = triple(), t[i] = triple();
    for (auto& one : n) one[2] = std::abs(one[2]) + 0.1f;
    const Corners left{{p[0], p[1], p[2]}, {n[0], n[1], n[2]}, {t[0], t[1], t[2]}, {}};
    const Corners right{{p[2], p[1], p[3]}, {n[2], n[1], n[3]}, {t[2], t[1], t[3]}, {}};
    for (const v1::Shading shading : {v1::GOURAUD, v1::QUADRATIC})
      for (double s : {0.0, 0.25, 0.7, 1.0}) {
        // The point b + s (c − b): u = 1 − s, v = s on the left, u = 1 − s, v = 0 on the right.
        const float on_left =
            interpolated(shading, seen(triangle_places(shading, left, side)), 1 - s, s);
        const float on_right =
            interpolated(shading, seen(triangle_places(shading, right, side)), 1 - s, 0);
        EXPECT_NEAR(on_left, on_right, 3e-6);
      }
  }
}

TEST(TrianglePlaces, ConstantLooksAtTheMiddleWithTheTrianglesOwnNormal) {
  const Corners corners{{{{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}},
                        {{{1, 0, 0}, {1, 0, 0}, {1, 0, 0}}},
                        {{{0, 1, 0}, {0, 1, 0}, {0, 1, 0}}},
                        {}};
  const TrianglePlaces places = triangle_places(v1::CONSTANT, corners, {0, 0, -1});
  EXPECT_EQ(places.count, 1);
  EXPECT_EQ(places.position.x[0], 1);
  EXPECT_EQ(places.position.y[0], 1);
  EXPECT_EQ(places.normal.z[0], -1);
}

TEST(TrianglePlaces, NormalsAreOnTheSideThatIsSeenAndTheTrianglesOwnWhereTheMeshHasNone) {
  const Corners corners{
      {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {{{0, 0, -2}, {0, 3, 4}, {0, 0, 0}}}, {}, {}};
  const TrianglePlaces places = triangle_places(v1::GOURAUD, corners, {0, 0, 1});
  EXPECT_FLOAT_EQ(places.normal.z[0], 1);
  EXPECT_FLOAT_EQ(places.normal.y[1], 0.6f);
  EXPECT_FLOAT_EQ(places.normal.z[1], 0.8f);
  EXPECT_FLOAT_EQ(places.normal.z[2], 1);
}

}  // namespace
}  // namespace metamer::cpu
