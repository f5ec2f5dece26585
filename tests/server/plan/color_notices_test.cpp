#include "server/plan/color_notices.h"

#include <gtest/gtest.h>

#include "common/scene/settings.h"
#include "common/spectral/cie.h"
#include "server/plan/plan.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

std::string scene(const std::string& light, const std::string& diffuse) {
  return "camera { eye { z: 3 } target {} } light { name: 'lamp' position { y: 2 } spectrum { " +
         light + " } } material { name: 'paint' diffuse { " + diffuse +
         " } } object { name: 'o' material: 'paint' sphere { radius: 1 } }";
}

std::vector<std::string> notices(const std::string& text, const v1::Method& method) {
  const RenderScene scene = compile_text(text);
  v1::Settings settings;
  *settings.mutable_method() = method;
  const v1::Plan made = make_plan(scene, with_defaults(settings), {.threads = 1});
  v1::Plan plan = made;
  plan.clear_notice();
  notice_colors(scene, *make_method(made, scene), plan);
  notice_ends_of_data(scene, plan);
  std::vector<std::string> told;
  for (const v1::Notice& one : plan.notice()) told.push_back(one.field() + ": " + one.message());
  return told;
}

using Texts = std::vector<std::string>;
const std::string grey = "constant: 0.5";

TEST(ColorNotices, SayNothingOfExactUnderAnyOfTheCiesLights) {
  for (const std::string& name : cie::illuminant_names())
    EXPECT_EQ(notices(scene("standard: '" + name + "'", grey), exact()), Texts{}) << name;
}

TEST(ColorNotices, SayHowFarAWhiteIsOff) {
  // Sodium's line, where samples by 5 nm see no more than that it is there.
  const std::string sodium = "samples { wavelength: [585, 589, 593] value: [0, 1, 0] }";
  v1::Method samples = uniform(400, 700, 5);
  samples.mutable_point()->set_lights(v1::Point::SAMPLES);
  const Texts told = notices(scene(sodium, grey), samples);
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].find("light[0].spectrum: by point 400:700:5, the white of light \"lamp\" is "
                         "ΔE00 "),
            0u)
      << told[0];
  EXPECT_NE(told[0].find("; method exact is not"), std::string::npos) << told[0];
}

TEST(ColorNotices, SayWhichMaterialIsOffMost) {
  const Texts told =
      notices(scene("standard: 'F11'",
                    "samples { wavelength: [400, 560, 600, 700] value: [0, 0, 0.9, 1] }"),
              rgb());
  ASSERT_EQ(told.size(), 1u);
  EXPECT_NE(told[0].find("\"paint\" is ΔE00 "), std::string::npos) << told[0];
  EXPECT_NE(told[0].find(" off under light \"lamp\""), std::string::npos) << told[0];
}

TEST(ColorNotices, SayThatALightStaysDark) {
  // A spike between two sample positions, and a light that nobody sees.
  v1::Method samples = uniform(400, 700, 5);
  samples.mutable_point()->set_lights(v1::Point::SAMPLES);
  EXPECT_EQ(
      notices(scene("samples { wavelength: [501, 502, 503] value: [0, 1, 0] }", grey), samples),
      Texts{"light[0].spectrum: light \"lamp\" stays dark: the observer sees nothing of it at "
            "these wavelengths"});
  EXPECT_EQ(notices(scene("samples { wavelength: [900, 950] value: [1, 1] }", grey), exact()),
            Texts{"light[0].spectrum: light \"lamp\" stays dark: the observer sees nothing of it"});
}

TEST(ColorNotices, SayWhereDataEndThatMatter) {
  const Texts told = notices(scene("samples { wavelength: [450, 650] value: [1, 1] }",
                                   "samples { wavelength: [500, 600] value: [0.1, 0.2] }"),
                             exact());
  ASSERT_EQ(told.size(), 2u);
  EXPECT_EQ(told[0].find("light[0].spectrum: its data end at 450 and 650 nm, where it still has "
                         "power: 0 beyond; its white would be ΔE00 "),
            0u)
      << told[0];
  EXPECT_EQ(told[1].find("material[0].diffuse: its data end at 500 and 600 nm: "), 0u) << told[1];
  // What most instruments give, and a lamp that has faded out.
  EXPECT_EQ(notices(scene("standard: 'D65'", "samples { wavelength: [400, 700] value: [0, 1] }"),
                    exact()),
            Texts{});
  EXPECT_EQ(
      notices(scene("samples { wavelength: [450, 500, 650] value: [0, 1, 0] }", grey), exact()),
      Texts{});
}

TEST(Point, ChoosesWhatLightsAreByTheSmallerError) {
  const std::string sodium = "samples { wavelength: [588, 589, 590] value: [0, 1, 0] }";
  const auto lights = [](const std::string& light) {
    const RenderScene made = compile_text(scene(light, grey));
    v1::Settings settings;
    *settings.mutable_method() = uniform(400, 700, 5);
    settings.mutable_method()->mutable_point()->clear_lights();
    return make_plan(made, with_defaults(settings), {.threads = 1}).method().point().lights();
  };
  EXPECT_EQ(lights(sodium), v1::Point::CELLS);
  // Its own samples lie at these wavelengths: their white is ΔE00 0.15 off, that of means 0.06.
  EXPECT_EQ(lights("standard: 'F11'"), v1::Point::CELLS);
  EXPECT_EQ(lights("standard: 'D65'"), v1::Point::SAMPLES);
  EXPECT_EQ(lights("samples { wavelength: [300, 900] value: [1, 1] }"), v1::Point::SAMPLES);
}

TEST(Point, OfOneWavelengthSeesALightWhereverItsLinesAre) {
  // A laser of 638 nm by a single wavelength of 550 nm has that one's colour, and all its
  // luminance.
  const RenderScene made =
      compile_text(scene("samples { wavelength: [637, 638, 639] value: [0, 1, 0] }", grey));
  v1::Settings settings;
  settings.mutable_method()->mutable_point()->add_wavelengths(550);
  settings.mutable_method()->mutable_point()->set_lights(v1::Point::CELLS);
  const v1::Plan plan = make_plan(made, with_defaults(settings), {.threads = 1});
  Gather gather(1);
  gather.weights(gather.surface(0, 0), 0) = {1, 0, 0};
  const auto method = make_method(plan, made);
  const auto xyz = method->resolve(gather, 1, *method->make_scratch());
  const auto& [x, y, z] = cie::observer_1931().functions();
  const double at_y = resample(y, {550}, Outside::zero).values[0];
  EXPECT_NEAR(xyz[1], 0.5, 1e-6);
  EXPECT_NEAR(xyz[0], 0.5 * resample(x, {550}, Outside::zero).values[0] / at_y, 1e-6);
  EXPECT_NEAR(xyz[2], 0.5 * resample(z, {550}, Outside::zero).values[0] / at_y, 1e-6);
}

TEST(Point, OfBandsThatDoNotSeeALightLeavesItDarkAndNotNegative) {
  for (const double nm : {403.0, 411.0, 690.0, 697.0}) {
    const std::string at = std::to_string(nm);
    const RenderScene made =
        compile_text(scene("samples { wavelength: " + at + " value: 1 }", grey));
    for (const double step : {5.0, 20.0, 50.0, 100.0}) {
      v1::Settings settings;
      *settings.mutable_method() = uniform(400, 700, step);
      settings.mutable_method()->mutable_point()->set_lights(v1::Point::CELLS);
      const v1::Plan plan = make_plan(made, with_defaults(settings), {.threads = 1});
      Gather gather(1);
      gather.weights(gather.surface(0, 0), 0) = {1, 0, 0};
      const auto method = make_method(plan, made);
      const float luminance = method->resolve(gather, 1, *method->make_scratch())[1];
      EXPECT_TRUE(luminance == 0 || std::abs(luminance - 0.5f) < 1e-4f) << nm << " by " << step;
    }
  }
}

}  // namespace
}  // namespace metamer::test
