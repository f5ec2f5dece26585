#include "server/methods/prefilter.h"

#include <gtest/gtest.h>

#include "server/plan/plan.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

RenderScene scene_of(const std::string& lights) {
  return compile_text("camera { eye { z: 3 } target {} } " + lights + R"(
    material {
      name: "paint"
      diffuse { samples { wavelength: [400, 500, 600, 700] value: [0.1, 0.7, 0.2, 0.5] } }
    }
    object { name: "o" material: "paint" sphere { radius: 1 } })");
}

std::string light(const std::string& name, const std::string& spectrum, double luminance) {
  return "light { name: '" + name + "' position { y: 2 } spectrum { " + spectrum +
         " } luminance: " + std::to_string(luminance) + " } ";
}

/// The paint under each light by itself.
std::vector<std::array<float, 3>> seen(const v1::Method& choice, const RenderScene& scene) {
  v1::Plan plan;
  *plan.mutable_method() = choice;
  const auto method = make_method(plan, scene);
  std::vector<std::array<float, 3>> result;
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    Gather gather(scene.lights.size());
    gather.weights(gather.surface(0, 0), i) = {1, 0, 0};
    result.push_back(resolve(*method, gather));
  }
  return result;
}

TEST(Prefilter, IsRightUnderTheDominantLightAndItsLikeAtAnyLuminance) {
  // Sodium is no colour of sRGB; deep red has no Z at all.
  for (const std::string spectrum : {"standard: 'A'", "standard: 'F11'",
                                     "samples { wavelength: [585, 589, 593] value: [0, 1, 0] }",
                                     "samples { wavelength: [690, 700, 710] value: [0, 1, 0] }"}) {
    const RenderScene scene = scene_of(light("a", spectrum, 2) + light("b", spectrum, 1));
    const auto one = seen(prefilter(), scene), other = seen(exact(), scene);
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(one[i][axis], other[i][axis], 2e-6) << spectrum;
  }
}

TEST(Prefilter, GivesOtherLightsTheirOwnColourAndSurfacesThatOfTheDominantOne) {
  const RenderScene scene =
      scene_of(light("a", "standard: 'D65'", 1) + light("b", "standard: 'F11'", 1));
  const auto one = seen(prefilter(), scene), other = seen(exact(), scene);
  float error = 0;
  for (std::size_t axis = 0; axis < 3; ++axis)
    error = std::max(error, std::abs(one[1][axis] - other[1][axis]));
  EXPECT_GT(error, 0.003f);  // metamerism is lost,
  EXPECT_LT(error, 0.1f);    // the light's own tint is not.
}

TEST(Prefilter, SaysWhichLightDominatesWhereItIsNotTheFirst) {
  v1::Plan plan;
  const RenderScene scene =
      scene_of(light("ir", "samples { wavelength: [850, 900] value: [1, 1] }", 1) +
               light("lamp", "samples { wavelength: [585, 589, 593] value: [0, 1, 0] }", 1));
  plan_prefilter(scene, {}, plan);
  ASSERT_EQ(plan.notice_size(), 2);
  EXPECT_EQ(plan.notice(0).message(),
            "light \"lamp\" is the dominant one: nothing is seen of those before it");
  EXPECT_EQ(plan.notice(1).message(),
            "light \"lamp\" has too little red, green or blue to divide by: X, Y and Z are "
            "filtered instead");
  plan.clear_notice();
  plan_prefilter(scene_of(light("a", "standard: 'A'", 1)), {}, plan);
  EXPECT_EQ(plan.notice_size(), 0);
}

}  // namespace
}  // namespace metamer::test
