#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/models/reference.h"
#include "server/cpu/shared_source.h"
#include "server/models/lanes.h"
#include "tests/extremes/table.h"
#include "tests/laws/random.h"

// Highlights from vectors, as a renderer has them: f32 against f64, for any sharpness and
// direction. tests/extremes holds f64 and f32 against 50 digits at fewer points.

namespace metamer::laws {
namespace {

using Eigen::Vector3d;
using models::Angles, models::Entry, models::Kind, models::Reflection;

/// What a highlight is right to, and of which share of its peak where it is less.
constexpr double relative = 1e-3, negligible = 1e-6;
/// The smallest N·L, N·V and R·V: a rounding of f32 is 1e-4 of it.
constexpr double horizon = 1e-3;

/// The angles of four f32 vectors, each the rounding of a unit vector, by f64 and by f32.
struct Point {
  Angles<double> f64;
  Angles<Floats> f32;
};

Vector3d rounded(const Vector3d& v) { return v.cast<float>().cast<double>(); }

/// A light anywhere above the horizon; a viewer anywhere, or 1e-6 to 1 from its mirror direction.
Point point(Random& random) {
  for (;;) {
    const Eigen::Quaterniond turn = Eigen::Quaterniond(random.between(-1, 1), random.between(-1, 1),
                                                       random.between(-1, 1), random.between(-1, 1))
                                        .normalized();
    const Vector3d to_light = random.direction();
    const Vector3d to_viewer = random.towards_mirror(to_light);
    if (to_light.z() < horizon || to_viewer.z() < horizon) continue;
    const Vector3d n = rounded(turn * normal), t = rounded(turn * tangent);
    const Vector3d l = rounded(turn * to_light), v = rounded(turn * to_viewer);
    const Vector3d up = n.normalized(), along = t.normalized();
    Point result;
    result.f64 = models::angles_between(up, (along - up.dot(along) * up).normalized(),
                                        l.normalized(), v.normalized(), 1);
    result.f32 = cpu::shared::angles_of(to_lanes(n), to_lanes(t), to_lanes(l), to_lanes(v),
                                        broadcast(1), true, true);
    return result;
  }
}

void expect_right(double f64, double f32, double peak, const Angles<double>& a, const char* name) {
  if (std::abs(f32 - f64) <= relative * std::max(f64, negligible * peak)) return;
  ADD_FAILURE() << name << " is " << f64 << " in f64, " << f32 << " in f32 at N·L " << a.n_dot_l
                << ", N·V " << a.n_dot_v << ", 1 − N·H " << a.n_h_versine << ", 1 − R·V "
                << a.r_v_versine << ", m² " << a.tangent;
}

TEST(PeakLaws, ModelsOfF32VectorsAreRightAtEverySharpness) {
  for (const Entry& model : models::registry(Kind::model)) {
    Random random;
    for (int i = 0; i < law_inputs / 20 && !HasFailure(); ++i) {
      const auto reflection = random.reflection(model);
      const Point at = point(random);
      const auto exact = models::evaluate(reflection, at.f64);
      const auto most = models::evaluate(reflection, mirrored(at.f64));
      const auto lobes = models::evaluate(extremes::single(reflection), at.f32);
      if (at.f64.r_dot_v < horizon) continue;
      SCOPED_TRACE(::testing::PrintToString(reflection.parameters) +
                   ::testing::PrintToString(reflection.slopes[0].parameters));
      const double peak = std::max({most.specular, most.white, most.fresnel});
      expect_right(exact.diffuse, lobes.diffuse[0], most.diffuse, at.f64, model.name);
      expect_right(exact.specular, lobes.specular[0], peak, at.f64, model.name);
      expect_right(exact.white, lobes.white[0], peak, at.f64, model.name);
      expect_right(exact.fresnel, lobes.fresnel[0], peak, at.f64, model.name);
    }
  }
}

TEST(PeakLaws, SlopesOfF32VectorsAreRightAtEverySharpness) {
  for (const Entry& slope : models::registry(Kind::slope)) {
    const auto which = static_cast<models::Slope>(slope.index);
    Random random;
    for (int i = 0; i < law_inputs / 20 && !HasFailure(); ++i) {
      auto parameters = random.parameters(slope);
      const auto single = extremes::single(parameters);
      std::copy(single.begin(), single.end(), parameters.begin());
      const Point at = point(random);
      SCOPED_TRACE(::testing::PrintToString(parameters));
      expect_right(models::slope(which, parameters, at.f64),
                   models::slope(which, single, at.f32)[0],
                   models::slope(which, parameters, mirrored(at.f64)), at.f64, slope.name);
    }
  }
}

}  // namespace
}  // namespace metamer::laws
