// Every method at the ends of what a scene may hold.

#include <gtest/gtest.h>

#include <cmath>

#include "common/color/xyz.h"
#include "server/methods/exact.h"
#include "server/plan/color_notices.h"
#include "server/plan/plan.h"
#include "tests/server/methods/dense.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

using Colour = std::array<float, 3>;

/// A scene of lights and of materials `paint` and `mirror`, which both have `diffuse` and
/// `specular`.
std::string scene_of(const std::string& lights, const std::string& surface) {
  return "camera { eye { z: 3 } target {} } " + lights + " material { name: 'paint' " + surface +
         " blinn_phong {} } material { name: 'mirror' mirror: 1 " + surface +
         " } object { name: 'o' material: 'paint' sphere { radius: 1 } }";
}

std::string light(const std::string& spectrum, const std::string& luminance = "1") {
  return "light { name: 'l' position { y: 2 } spectrum { " + spectrum +
         " } luminance: " + luminance + " } ";
}

const char* const colored =
    "diffuse { samples { wavelength: [400, 500, 600, 700] value: [0.1, 0.7, 0.2, 0.5] } } "
    "specular { samples { wavelength: [400, 700] value: [0.9, 0.3] } }";

v1::Plan plan_for(const v1::Method& method, const RenderScene& scene) {
  v1::Settings settings;
  *settings.mutable_method() = method;
  return make_plan(scene, settings, {.threads = 1});
}

v1::Plan noticed(const v1::Method& method, const RenderScene& scene) {
  v1::Plan plan = plan_for(method, scene);
  notice_colors(scene, *make_method(plan, scene), plan);
  return plan;
}

/// The paint under the first light, directly and over the mirror.
struct Seen {
  Colour direct, mirrored;
};
Seen see(const v1::Method& choice, const RenderScene& scene) {
  const auto method = make_method(plan_for(choice, scene), scene);
  Gather gather(scene.lights.size());
  gather.weights(gather.surface(0, 0), 0) = {1, 0, 0};
  const Colour direct = resolve(*method, gather);
  gather.clear();
  const auto mirrored = gather.chain(0, {FactorKind::specular, 1, 1});
  gather.weights(gather.surface(mirrored, 0), 0) = {0.5f, 0.25f, 0.125f};
  return {direct, resolve(*method, gather)};
}

bool is_finite(const Seen& seen) {
  for (std::size_t i = 0; i < 3; ++i)
    if (!std::isfinite(seen.direct[i]) || !std::isfinite(seen.mirrored[i])) return false;
  return true;
}

bool is_dark(const Seen& seen) {
  return seen.direct == Colour{0, 0, 0} && seen.mirrored == Colour{0, 0, 0};
}

bool has_notice(const v1::Plan& plan, const std::string& part) {
  for (const v1::Notice& notice : plan.notice())
    if (notice.message().find(part) != std::string::npos) return true;
  return false;
}

/// The white of a light of luminance 1: as a method's own wavelengths see it, or as it is.
Xyz white_of(const RenderScene& scene, const v1::Method& method) {
  const bool sampled = method.has_point() && !method.point().has_fitted();
  const Wavelengths wavelengths = sampled ? method_wavelengths(method) : dense();
  const bool cells = method.point().lights() == v1::Point::CELLS;
  const ObserverWeights observer = cells ? observer_of_bands(cie::observer_1931(), wavelengths.nm())
                                         : observer_weights(cie::observer_1931(), wavelengths);
  auto power = cells ? band_means(scene.emissions[0], wavelengths.nm())
                     : resample(scene.emissions[0], wavelengths.nm(), Outside::zero).values;
  const double scale = luminance_scale(observer, power, 1);
  for (double& value : power) value *= scale;
  return to_xyz(observer, power);
}

TEST(MethodExtremes, NeutralStaysNeutral) {
  for (const char* illuminant : {"E", "D65", "A", "F11"})
    for (const double grey : {1.0, 0.5, 0.01}) {
      const std::string constant = "{ constant: " + std::to_string(grey) + " }";
      const RenderScene scene =
          compile_text(scene_of(light("standard: '" + std::string(illuminant) + "'"),
                                "diffuse " + constant + " specular " + constant));
      for (const v1::Method& method : all_methods()) {
        const Xyz white = white_of(scene, method);
        const Seen seen = see(method, scene);
        const double over_mirror = grey * (0.75 * grey + 0.125);
        for (std::size_t i = 0; i < 3; ++i) {
          EXPECT_NEAR(seen.direct[i] / grey, white[i], 1e-6 * std::max(white[i], 1.0))
              << illuminant << " on " << grey << " by " << method.ShortDebugString();
          EXPECT_NEAR(seen.mirrored[i] / over_mirror, white[i], 1e-6 * std::max(white[i], 1.0))
              << illuminant << " on " << grey << " by " << method.ShortDebugString();
        }
      }
    }
}

TEST(MethodExtremes, BrightnessIsAFactorFrom1em20To1e20) {
  const RenderScene one = compile_text(scene_of(light("standard: 'F2'"), colored));
  for (const v1::Method& method : all_methods()) {
    const Seen usual = see(method, one);
    for (const char* luminance : {"1e-20", "1e20"}) {
      const Seen seen =
          see(method, compile_text(scene_of(light("standard: 'F2'", luminance), colored)));
      for (std::size_t i = 0; i < 3; ++i) {
        const double factor = std::stod(luminance);
        EXPECT_NEAR(seen.direct[i] / factor, usual.direct[i], 2e-6 * usual.direct[1])
            << luminance << " by " << method.ShortDebugString();
        EXPECT_NEAR(seen.mirrored[i] / factor, usual.mirrored[i], 2e-6 * usual.mirrored[1])
            << luminance << " by " << method.ShortDebugString();
      }
    }
  }
}

TEST(MethodExtremes, ALightOfNoLuminanceIsDark) {
  for (const v1::Method& method : all_methods())
    EXPECT_TRUE(is_dark(see(method, compile_text(scene_of(light("standard: 'A'", "0"), colored)))))
        << method.ShortDebugString();
}

TEST(MethodExtremes, ALightOfNoPowerIsDark) {
  // No scene file may hold one; a plan must still not divide by it.
  RenderScene scene = compile_text(scene_of(light("standard: 'A'"), colored));
  for (double& value : scene.emissions[0].values) value = 0;
  for (const v1::Method& method : all_methods())
    EXPECT_TRUE(is_dark(see(method, scene))) << method.ShortDebugString();
}

TEST(MethodExtremes, LightOutsideTheVisibleIsDarkAndSaidToBe) {
  for (const char* range : {"[200, 340]", "[850, 1100]"}) {
    const RenderScene scene = compile_text(scene_of(
        light("samples { wavelength: " + std::string(range) + " value: [1, 2] }"), colored));
    for (const v1::Method& method : all_methods()) {
      EXPECT_TRUE(is_dark(see(method, scene))) << range << " by " << method.ShortDebugString();
      EXPECT_TRUE(has_notice(noticed(method, scene), "light \"l\" stays dark"))
          << range << " by " << method.ShortDebugString();
    }
  }
}

TEST(MethodExtremes, ADarkLightDoesNotDisturbTheOthers) {
  const std::string lamp = "light { name: 'lamp' position { y: 1 } spectrum { standard: 'F11' } } ";
  const RenderScene alone = compile_text(scene_of(lamp, colored));
  const RenderScene after = compile_text(
      scene_of(light("samples { wavelength: [850, 1100] value: [1, 2] }") + lamp, colored));
  for (const v1::Method& method : all_methods()) {
    Gather gather(2);
    const auto surface = gather.surface(0, 0);
    gather.weights(surface, 0) = gather.weights(surface, 1) = {1, 0, 0};
    const Colour both = resolve(*make_method(plan_for(method, after), after), gather);
    const Colour one = see(method, alone).direct;
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(both[i], one[i], 1e-6) << method.ShortDebugString();
  }
}

TEST(MethodExtremes, ASpikeBetweenTwoPositionsIsSaidToBeMissed) {
  // Half of the luminance lies in a line at 551.25 nm, 0.5 nm wide: between any two nanometres.
  const RenderScene scene = compile_text(scene_of(
      light("samples { wavelength: [400, 551.05, 551.25, 551.45, 700] value: [1, 1, 500, 1, 1] }"),
      colored));
  for (const v1::Method& method : all_methods()) {
    EXPECT_TRUE(is_finite(see(method, scene))) << method.ShortDebugString();
    // 0.075 nm see most of the line, and whatever integrates gets its white right.
    if (method.point().step() == 0.075) continue;
    const bool sampled = method.has_point() && method.point().lights() == v1::Point::SAMPLES;
    const bool integrated = method.has_exact() || method.has_prefilter() || method.has_rgb();
    const bool told = has_notice(noticed(method, scene), "the white of light");
    if (!integrated && !sampled) continue;
    EXPECT_EQ(told, !integrated) << method.ShortDebugString();
  }
}

TEST(MethodExtremes, AReflectanceBetweenTwoPositionsIsSaidToBeMissed) {
  const RenderScene scene = compile_text(scene_of(
      light("standard: 'E'"),
      "diffuse { samples { wavelength: [400, 541, 542, 543, 700] value: [0, 0, 1, 0, 0] } }"));
  EXPECT_TRUE(has_notice(noticed(uniform(400, 700, 5), scene), "is ΔE00 "));
  EXPECT_FALSE(has_notice(noticed(exact(), scene), "ΔE00"));
}

TEST(MethodExtremes, IdenticalSpectraCountOnce) {
  const std::string twins =
      light("standard: 'D65'") +
      "light { name: 'm' position { y: 1 } spectrum { standard: 'D65' } luminance: 0.5 } ";
  const RenderScene one = compile_text(scene_of(light("standard: 'D65'"), colored));
  const RenderScene two = compile_text(scene_of(twins, colored));
  for (const v1::Method& method : all_methods()) {
    const Seen alone = see(method, one), twin = see(method, two);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(twin.direct[i], alone.direct[i], 2e-6) << method.ShortDebugString();
  }
}

TEST(MethodExtremes, SpectraThatAreAllAlikeNeedOneValue) {
  // Of rank one: one light on greys.
  const RenderScene scene = compile_text(
      scene_of(light("standard: 'F11'"), "diffuse { constant: 0.5 } specular { constant: 0.2 }"));
  EXPECT_EQ(plan_for(linear(16), scene).bands(), 1u);
  EXPECT_EQ(plan_for(linear(16, v1::Linear::OBSERVER, true), scene).bands(), 1u);
  EXPECT_TRUE(has_notice(noticed(linear(16), scene), "span no more than 1 function"));
  EXPECT_EQ(plan_for(fitted(64), scene).bands(), 1u);
  EXPECT_TRUE(has_notice(noticed(fitted(64), scene), "need no more than 1 wavelength"));
}

TEST(MethodExtremes, SurfacesOfNoReflectanceAreBlack) {
  const RenderScene scene = compile_text(
      scene_of(light("standard: 'A'"), "diffuse { constant: 0 } specular { constant: 0 }"));
  for (const v1::Method& method : all_methods())
    EXPECT_TRUE(is_dark(see(method, scene))) << method.ShortDebugString();
}

}  // namespace
}  // namespace metamer::test
