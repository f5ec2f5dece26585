#include "server/plan/plan.h"

#include <gtest/gtest.h>

#include "common/scene/settings.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

std::string scene(const std::string& light, const std::string& material,
                  const std::string& settings) {
  return "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 2 } " + light +
         " } material { name: 'm' " + material +
         " } material { name: 'unused' mirror: 1 blinn_phong {} } object { name: 'o' material: 'm' "
         "sphere { radius: 1 } } settings { " +
         settings + " }";
}

v1::Plan plan(const std::string& text, Features features = Features::all()) {
  return make_plan(test::compile_text(text), with_defaults(test::parse_scene(text).settings()),
                   {.threads = 2, .backend = "gl", .features = features});
}

TEST(Plan, GoesNoDeeperThanItsMirrors) {
  EXPECT_EQ(plan(scene("spectrum { standard: 'E' }", "", "depth: 9")).depth(), 0u);
  EXPECT_EQ(plan(scene("spectrum { standard: 'E' }", "mirror: 0.1", "depth: 9")).depth(), 9u);
}

TEST(Plan, BoundsTheWorkOfATile) {
  for (const std::uint32_t spp : {1u, 4u, 16u, 17u, 100u, 1024u})
    for (const std::uint32_t side : {8u, 16u, 64u, 256u}) {
      const std::string wanted =
          "spp: " + std::to_string(spp) + " tile_size: " + std::to_string(side);
      const v1::Plan made = plan(scene("spectrum { standard: 'E' }", "", wanted));
      const std::uint32_t tile = made.tile_size();
      EXPECT_LE(tile, side);
      EXPECT_EQ(tile % 8, 0u);
      EXPECT_TRUE(tile == 8 || std::uint64_t{tile} * tile * spp <= max_tile_samples) << wanted;
      const std::uint64_t next = tile + 8;
      EXPECT_TRUE(tile == side || next * next * spp > max_tile_samples) << wanted;
      EXPECT_EQ(made.notice_size(), tile == side ? 0 : 1) << wanted;
    }
}

TEST(Plan, SaysWhatABackendLeavesOut) {
  const Features no_mirrors = Features::all().without({Feature::mirrors});
  const v1::Plan gl = plan(scene("spectrum { standard: 'E' }", "mirror: 0.1", ""), no_mirrors);
  EXPECT_EQ(gl.backend(), "gl");
  EXPECT_EQ(gl.depth(), 0u);
  ASSERT_EQ(gl.notice_size(), 1);
  EXPECT_EQ(gl.notice(0).field(), "material[0].mirror");
  EXPECT_EQ(gl.notice(0).message(), "the gl backend has no mirrors");
  // The scene's other material mirrors, and no object is of it.
  EXPECT_EQ(plan(scene("spectrum { standard: 'E' }", "", ""), no_mirrors).notice_size(), 0);
  EXPECT_EQ(plan(scene("spectrum { standard: 'E' }", "mirror: 0.1", "depth: 0"), no_mirrors)
                .notice_size(),
            0);
}

TEST(Plan, SaysThatABackendHasNoPasses) {
  const std::string passes = "method { point { from: 400 to: 700 step: 5 multi_pass: true } } ";
  const v1::Plan cpu = plan(scene("spectrum { standard: 'E' }", "", passes),
                            Features::all().without({Feature::multi_pass}));
  ASSERT_EQ(cpu.notice_size(), 1);
  EXPECT_EQ(cpu.notice(0).message(), "has no effect: the gl backend has no passes");
  EXPECT_EQ(cpu.notice(0).field(), "settings.method.point.multi_pass");
  EXPECT_EQ(plan(scene("spectrum { standard: 'E' }", "", passes)).notice_size(), 0);
}

TEST(Plan, ListsOnlyTheModelsThatObjectsUse) {
  const v1::Plan lambert = plan(scene("spectrum { standard: 'E' }", "", ""));
  EXPECT_EQ(lambert.models_size(), 1);
  EXPECT_EQ(lambert.models(0), "lambert");
}

TEST(Plan, FillsInEveryDefault) {
  const v1::Plan defaults = plan(scene("spectrum { standard: 'E' }", "", ""));
  EXPECT_EQ(defaults.width(), 640u);
  EXPECT_EQ(defaults.height(), 480u);
  EXPECT_EQ(defaults.spp(), 16u);
  EXPECT_EQ(defaults.tile_size(), 16u);
  EXPECT_EQ(defaults.threads(), 2u);
  EXPECT_TRUE(defaults.method().has_exact());
  EXPECT_EQ(defaults.from(), 360);
  EXPECT_EQ(defaults.to(), 830);
  EXPECT_EQ(defaults.notice_size(), 0);
}

TEST(Plan, SaysWhereUniformWavelengthsEndEarly) {
  const v1::Plan plan_of_sevens = plan(
      scene("spectrum { standard: 'E' }", "", "method { point { from: 400 to: 700 step: 7 } }"));
  ASSERT_EQ(plan_of_sevens.notice_size(), 1);
  EXPECT_EQ(plan_of_sevens.notice(0).message(),
            "the last wavelength is 694 nm: 700 nm is no whole number of steps away");
}

TEST(Plan, KeepsTheDevelopmentAndTheDominantLightsWhite) {
  const v1::Plan by_a = plan(scene("luminance: 7 spectrum { standard: 'A' }", "",
                                   "development { adaptation: SHARP rgb_space: REC_2020 }"));
  EXPECT_EQ(by_a.development().adaptation(), v1::SHARP);
  EXPECT_EQ(by_a.development().rgb_space(), v1::REC_2020);
  ASSERT_EQ(by_a.source_white_size(), 3);
  // CIE 15:2004, table T.3, from tables of 1 nm; ours have lines between 5 nm.
  EXPECT_NEAR(by_a.source_white(0), 1.0985, 1e-4);
  EXPECT_NEAR(by_a.source_white(1), 1, 1e-14);
  EXPECT_NEAR(by_a.source_white(2), 0.3558, 2e-4);

  // By the observer that was chosen, whatever the method's wavelengths.
  const v1::Plan by_ten =
      plan(scene("spectrum { standard: 'A' }", "",
                 "observer: CIE_1964_10DEG method { point { wavelengths: 550 } }"));
  EXPECT_NEAR(by_ten.source_white(0), 1.1114, 2e-4);
  const v1::Plan dark =
      plan(scene("spectrum { samples { wavelength: [900, 950] value: [1, 1] } }", "", ""));
  EXPECT_EQ(dark.source_white_size(), 0);
}

TEST(Plan, IsAFunctionOfItsArguments) {
  const std::string text = scene("spectrum { standard: 'F11' }", "blinn_phong {}", "");
  EXPECT_EQ(plan(text).SerializeAsString(), plan(text).SerializeAsString());
}

}  // namespace
}  // namespace metamer
