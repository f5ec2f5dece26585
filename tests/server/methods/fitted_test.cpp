#include "server/methods/fitted.h"

#include <gtest/gtest.h>

#include "server/methods/training_set.h"
#include "server/plan/plan.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

std::string light(const std::string& name, const std::string& spectrum) {
  return "light { name: '" + name + "' position { y: 2 } spectrum { " + spectrum + " } } ";
}

/// Smooth paints, all different, `mirrors` of them mirrors.
RenderScene scene_of(const std::string& lights, unsigned paints, unsigned mirrors = 0) {
  std::string text = "camera { eye { z: 3 } target {} } " + lights +
                     " object { name: 'o' material: 'white' sphere { radius: 1 } }"
                     " material { name: 'white' diffuse { constant: 1 } }";
  for (unsigned i = 0; i < paints; ++i) {
    const double t = i / double(paints);
    const std::string spectrum = "{ samples { wavelength: [400, 500, 600, 700] value: [" +
                                 std::to_string(t) + ", 0.7, " + std::to_string(1 - t) + ", " +
                                 std::to_string(t * t) + "] } }";
    text += " material { name: '" + std::to_string(i) + "' diffuse " + spectrum +
            (i < mirrors ? " mirror: 1 specular " + spectrum : "") + " }";
  }
  return compile_text(text);
}

v1::Plan plan_for(const v1::Method& method, const RenderScene& scene) {
  v1::Settings settings;
  *settings.mutable_method() = method;
  return make_plan(scene, settings, {.threads = 1});
}

/// A material of the scene under one of its lights.
std::array<float, 3> seen(const v1::Method& method, const RenderScene& scene,
                          std::uint32_t material, std::size_t light) {
  Gather gather(scene.lights.size());
  gather.weights(gather.surface(0, material), light) = {1, 0, 0};
  return resolve(*make_method(plan_for(method, scene), scene), gather);
}

TEST(Fitted, OfALightOfThreeLinesTakesTheLines) {
  // Paints hardly change within a line, so that its power at one wavelength tells all.
  const RenderScene scene = scene_of(
      light("l",
            "samples { wavelength: [434, 436, 438, 544, 546, 548, 609, 611, 613] value: [0, 2, "
            "0, 0, 1, 0, 0, 3, 0] }"),
      12);
  const auto nm = fitted_wavelengths(scene, cie::observer_1931(), 3);
  ASSERT_EQ(nm.size(), 3u);
  EXPECT_NEAR(nm[0], 436, 1);
  EXPECT_NEAR(nm[1], 546, 1);
  EXPECT_NEAR(nm[2], 611, 1);
  for (std::uint32_t paint = 1; paint <= 12; ++paint)
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(seen(fitted(3), scene, paint, 0)[axis], seen(exact(), scene, paint, 0)[axis],
                  3e-3);
}

TEST(Fitted, KeepsTheWhiteOfEachOfSeveralLights) {
  const RenderScene scene =
      scene_of(light("a", "standard: 'A'") + light("b", "standard: 'F11'") +
                   light("c", "standard: 'D65'") + light("d", "standard: 'A'"),
               6);
  for (std::size_t i = 0; i < 4; ++i) {
    const auto one = seen(fitted(8), scene, 0, i), other = seen(exact(), scene, 0, i);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(one[axis], other[axis], 1e-6) << i;
  }
}

TEST(Fitted, OfMoreLightsThanWavelengthsKeepsTheFirstOnes) {
  std::string lights;
  for (int i = 1; i <= 12; ++i)
    lights += light("f" + std::to_string(i), "standard: 'F" + std::to_string(i) + "'");
  const RenderScene scene = scene_of(lights, 6);
  for (std::size_t i = 0; i < 12; ++i) {
    const auto one = seen(fitted(4), scene, 0, i), other = seen(exact(), scene, 0, i);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(one[axis], other[axis], i < 2 ? 1e-6 : 0.15) << i;
  }
}

TEST(Fitted, ThePlanListsTheWavelengthsAndTheMethodTakesThose) {
  const RenderScene scene = scene_of(light("l", "standard: 'F2'"), 9);
  v1::Plan plan = plan_for(fitted(3), scene);
  ASSERT_EQ(plan.wavelength_size(), 3);
  EXPECT_EQ(plan.bands(), 3u);
  EXPECT_EQ(plan.from(), plan.wavelength(0));
  EXPECT_EQ(plan.to(), plan.wavelength(2));
  EXPECT_EQ(plan.SerializeAsString(), plan_for(fitted(3), scene).SerializeAsString());

  Gather gather(1);
  gather.weights(gather.surface(0, 3), 0) = {1, 0, 0};
  const auto as_planned = resolve(*make_method(plan, scene), gather);
  plan.set_wavelength(1, plan.wavelength(1) + 15);
  EXPECT_NE(resolve(*make_method(plan, scene), gather), as_planned);
}

TEST(TrainingSet, IsBoundedHoweverManyLightsAndSurfacesThereAre) {
  const std::string lights = light("a", "standard: 'A'") + light("b", "standard: 'E'");
  for (const unsigned paints : {5u, 40u, 300u}) {
    const RenderScene scene = scene_of(lights, paints, paints);
    const TrainingSet set = make_training_set(scene, cie::observer_1931(), 500);
    EXPECT_LE(set.spectra.cols(), 500);
    EXPECT_EQ(set.whites, 2);
    EXPECT_TRUE(set.weights.allFinite());
  }
  // Two lights by themselves, over white and five paints, and over those in five mirrors.
  EXPECT_EQ(make_training_set(scene_of(lights, 5, 5), cie::observer_1931()).spectra.cols(),
            2 * (1 + 6 + 5 * 6));
  EXPECT_EQ(make_training_set(scene_of(lights, 5), cie::observer_1931()).spectra.cols(),
            2 * (1 + 6));
}

}  // namespace
}  // namespace metamer::test
