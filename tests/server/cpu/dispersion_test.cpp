// Wavelengths that go their own ways.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "server/plan/plan.h"
#include "server/scene/bundles.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

const std::string shining =
    "material { name: 'glow' diffuse { constant: 1 } phong { ambient: 1 } } ";

std::string glass_of(const std::string& medium) {
  return "material { name: 'glass' fresnel { dielectric { medium: '" + medium +
         "' } } transmission { dispersion: true } } ";
}

std::string light_of(const std::string& spectrum) {
  return "light { name: 'l' direction { z: -1 } spectrum { " + spectrum + " } } ";
}

TEST(Dispersion, BundlesSumTo1AndDifferByHalfAPixelsAngle) {
  for (const char* medium : {"N-BK7", "N-SF11", "water", "diamond"}) {
    const RenderScene scene = compile_text(
        "camera { eye { z: 9 } target {} vertical_fov: 40 } settings { height: 100 } " +
        light_of("standard: 'E'") + glass_of(medium) +
        "object { name: 'o' material: 'glass' sphere { radius: 1 } }");
    ASSERT_GE(scene.windows.size(), 2u);
    EXPECT_LE(scene.windows.size(), max_bundles);
    for (double nm = 300; nm < 900; nm += 0.37) {
      double sum = 0;
      for (const Spectrum& window : scene.windows)
        sum += resample(window, {nm}, Outside::hold).values[0];
      ASSERT_NEAR(sum, 1, 1e-12) << nm;
    }
    const double allowed = 2 * std::tan(20 * std::numbers::pi / 180) / 100 / 2;
    for (std::size_t b = 1; b < scene.windows.size(); ++b)
      EXPECT_LE(index_in(scene, scene.media[1], scene.windows[b - 1]) -
                    index_in(scene, scene.media[1], scene.windows[b]),
                allowed * 1.0001)
          << medium << ' ' << b;
    v1::Settings settings;
    const v1::Plan plan = make_plan(scene, settings, {.threads = 1});
    EXPECT_EQ(static_cast<std::size_t>(plan.bundle_size()), scene.windows.size());
  }
}

TEST(Dispersion, TooSmallPixelsAreTold) {
  const RenderScene scene = compile_text(
      "camera { eye { z: 9 } target {} vertical_fov: 1 } " + light_of("standard: 'E'") +
      glass_of("N-SF11") + "object { name: 'o' material: 'glass' sphere { radius: 1 } }");
  EXPECT_EQ(scene.windows.size(), max_bundles);
  ASSERT_EQ(scene.notices.size(), 1u);
  EXPECT_EQ(scene.notices[0].field, "settings.height");
}

TEST(Dispersion, KeepsEnergy) {
  // In a furnace a dispersing ball is as invisible as another, in every colour.
  for (const char* x : {"0", "0.4", "0.8"}) {
    const auto of = [&](const std::string& spectrum) {
      return render("camera { eye { z: 5 x: " + std::string(x) + " } target { z: -90 x: " + x +
                    " } vertical_fov: 0.01 } settings { width: 1 height: 1 spp: 1 depth: 64 "
                    "cutoff: 1e-6 } " +
                    light_of(spectrum) + shining + glass_of("N-SF11") +
                    "object { name: 'room' material: 'glow' sphere { radius: 99 } } object { name: "
                    "'ball' material: 'glass' sphere { radius: 1 } }")
          .at(0, 0);
    };
    for (const char* spectrum : {"standard: 'E'", "line { nm: 440 power: 1 }"})
      EXPECT_NEAR(of(spectrum)[1], 1, 4e-4) << x << ' ' << spectrum;
  }
}

/// A direction in a plane, bent by Snell's law at a line with the normal `angle` (both from the z
/// axis towards x) from n = `from` to n = `to`.
double bent(double direction, double normal, double from, double to) {
  return normal + std::asin(from / to * std::sin(direction - normal));
}

constexpr double half_apex = std::numbers::pi / 6;

/// Where a ray from the eye, going down −z but for the angle `up`, that meets the front face of the
/// prism meets the plane z = −`far`: x.
double behind_prism(double eye_x, double eye_z, double up, double n, double far) {
  // The faces are x = top − |z|/tan(30°); angles are those of directions from −z towards +x.
  const double top = 4 / std::sqrt(3.0), steep = 1 / std::tan(half_apex);
  // Front: x = top − steep z. The ray: x = eye_x + (eye_z − z) tan(up).
  const double z1 = (top - eye_x - eye_z * std::tan(up)) / (steep - std::tan(up));
  const double x1 = top - steep * z1;
  const double inward = -half_apex;  // the front's normal
  const double within = bent(up, inward, 1, n);
  // Back: x = top + steep z.
  const double z2 = (x1 + z1 * std::tan(within) - top) / (steep + std::tan(within));
  const double x2 = top + steep * z2;
  const double out = bent(within, -inward, n, 1);
  return x2 + (z2 + far) * std::tan(out);
}

TEST(Dispersion, APrismPutsASlitWhereItsGlassDoes) {
  // n by SCHOTT's formulas at these lines.
  struct Case {
    const char* medium;
    double nm, n;
  };
  for (const Case& one :
       {Case{"N-BK7", 450, 1.525320}, Case{"N-BK7", 546.1, 1.518721}, Case{"N-BK7", 640, 1.514846},
        Case{"N-SF11", 560, 1.789295}, Case{"N-SF11", 632.8, 1.778602}}) {
    const bool flint = one.medium[2] == 'S';
    // The eye and the slit at the minimum's angle for the d line, 20 and 40 away.
    const double nd = flint ? 1.78472 : 1.51680;
    const double half = std::asin(nd * 0.5) - half_apex;  // of the deviation
    // by rays through the middles of the faces, at x = 1/√3 and z = ±1.
    const double eye_z = 20, far = 40, face_x = 1 / std::sqrt(3.0);
    const double eye_x = face_x - (eye_z - 1) * std::tan(half);
    const double slit = face_x - (far - 1) * std::tan(half), width = 0.4;
    constexpr int rows = 300;
    constexpr double fov = 12;
    const auto picture = render(
        "camera { eye { x: " + std::to_string(eye_x) + " z: 20 } target { x: " +
        std::to_string(face_x) + " z: 1 } up { x: 1 } vertical_fov: " + std::to_string(fov) +
        " } settings { width: 1 height: 300 spp: 16 depth: 2 cutoff: 0.004 } " +
        light_of("line { nm: " + std::to_string(one.nm) + " power: 1 }") + shining +
        glass_of(one.medium) +
        "object { name: 'front' material: 'glass' quad { corner { x: -1.1547005 y: -5 z: 2 } u { "
        "x: 3.4641016 z: -2 } v { y: 10 } } } "
        "object { name: 'back' material: 'glass' quad { corner { x: 2.3094011 y: -5 } u { x: "
        "-3.4641016 z: -2 } v { y: 10 } } } "
        "object { name: 'base' material: 'glass' quad { corner { x: -1.1547005 y: -5 z: -2 } u { "
        "z: 4 "
        "} v { y: 10 } } } "
        "object { name: 'slit' material: 'glow' quad { corner { x: " +
        std::to_string(slit - width / 2) + " y: -50 z: -40 } u { x: " + std::to_string(width) +
        " } v { y: 100 } } }");
    // Where it should be, and the middle of what is bright about there: the base shows a second
    // one.
    double low = -0.1, high = 0.1;  // of the angle to the axis; x rises with it
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      (behind_prism(eye_x, eye_z, half + middle, one.n, far) > slit ? high : low) = middle;
    }
    double sum = 0, moment = 0;
    for (int row = 0; row < rows; ++row) {
      const double y = double{picture.at(0, static_cast<std::uint32_t>(row))[1]};
      const double tangent =
          std::tan(fov / 2 * std::numbers::pi / 180) * (1 - 2 * (row + 0.5) / rows);
      if (std::abs(std::atan(tangent) - low) > 0.015) continue;
      sum += y;
      moment += y * std::atan(tangent);
    }
    ASSERT_GT(sum, 1) << one.medium << ' ' << one.nm;
    EXPECT_NEAR(moment / sum, low, 1e-4) << one.medium << ' ' << one.nm;
  }
}

}  // namespace
}  // namespace metamer::test
