#include "server/plan/features.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "common/scene/settings.h"
#include "server/plan/plan.h"
#include "tests/server/cpu/soft/sky_file.h"
#include "tests/server/scene/small_png.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

constexpr const char* both =
    "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 2 } spectrum { standard: "
    "'E' "
    "} } material { name: 'paint' blinn_phong {} } material { name: 'gold' mirror: 0.5 "
    "cook_torrance {} fresnel { conductor { metal: 'Au' } } specularness: 1 slope { ward { "
    "roughness_u: 0.1 roughness_v: 0.4 } } } ";

std::string object(const std::string& name, const std::string& material) {
  return "object { name: '" + name + "' material: '" + material + "' sphere { radius: 1 } } ";
}

std::vector<Need> needs_of(const std::string& text) {
  return features_of(test::compile_text(text), with_defaults(test::parse_scene(text).settings()));
}

TEST(Features, HaveANameEach) {
  EXPECT_STREQ(name_of(Feature::mirrors), "mirrors");
  EXPECT_EQ(feature_names().size(), static_cast<std::size_t>(Feature::alpha) + 1);
  for (std::size_t i = 0; i < feature_names().size(); ++i)
    EXPECT_TRUE(Features::all().has(static_cast<Feature>(i))) << feature_names()[i];
}

TEST(Features, MapsAreAskedForByTheObjectsThatHaveThem) {
  const std::string text =
      "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 2 } spectrum { standard: "
      "'E' } } material { name: 'bumpy' bump_map { file: 'a.png' } } material { name: 'holed' "
      "alpha "
      "{ file: 'a.png' } } " +
      object("a", "bumpy") + object("b", "holed");
  const std::vector<Need> needs =
      features_of(test::compile_text(text, {{"a.png", test::small_png(1, 1, 0, {'\x80'})}}),
                  with_defaults(test::parse_scene(text).settings()));
  const std::vector<Problem> refused = refuse_unsupported(
      needs, {"toy backend", Features::all().without({Feature::normal_maps, Feature::alpha})});
  ASSERT_EQ(refused.size(), 2u);
  EXPECT_EQ(refused[0].field, "material[0]");
  EXPECT_EQ(refused[0].message, "the toy backend has no normal or bump maps");
  EXPECT_EQ(refused[1].field, "material[1].alpha");
  EXPECT_EQ(refused[1].message, "the toy backend shows surfaces as a whole, without alpha");
}

TEST(Features, AreASet) {
  const Features some{Feature::mirrors, Feature::factors};
  EXPECT_TRUE(some.has(Feature::factors));
  EXPECT_FALSE(some.has(Feature::anisotropy));
  EXPECT_FALSE(some.without({Feature::factors}).has(Feature::factors));
  EXPECT_TRUE(some.without({Feature::factors}).has(Feature::mirrors));
}

TEST(Features, AreThoseOfTheObjectsAlone) {
  EXPECT_TRUE(needs_of(both + object("a", "paint")).empty());  // nothing is of gold
}

TEST(Features, AreListedOnceWithTheirFirstPlace) {
  const auto needs =
      needs_of(both + object("a", "paint") + object("b", "gold") + object("c", "gold"));
  ASSERT_EQ(needs.size(), 3u);
  EXPECT_EQ(needs[0].feature, Feature::mirrors);
  EXPECT_EQ(needs[0].field, "material[1].mirror");
  EXPECT_EQ(needs[1].feature, Feature::exact_fresnel);
  EXPECT_EQ(needs[1].field, "material[1].fresnel");
  EXPECT_EQ(needs[2].feature, Feature::anisotropy);
  EXPECT_EQ(needs[2].field, "material[1]");
  for (const Need& need : needs) EXPECT_EQ(need.count, 1u);  // two objects, one material
}

TEST(Features, WithoutDepthNothingMirrors) {
  const auto needs = needs_of(both + object("a", "gold") + "settings { depth: 0 }");
  ASSERT_EQ(needs.size(), 2u);
  EXPECT_EQ(needs[0].feature, Feature::exact_fresnel);
}

/// Every feature that is needed and not supported is told once, as a notice or as a problem.
TEST(Features, WhatIsNotSupportedIsToldOnce) {
  std::vector<Need> needs;
  for (std::size_t i = 0; i < feature_names().size(); ++i)
    needs.push_back({static_cast<Feature>(i), "here", 3});
  v1::Plan plan;
  notice_unsupported(needs, {"toy backend", {}}, plan);
  const auto problems = refuse_unsupported(needs, {"toy backend", {}});
  EXPECT_EQ(static_cast<std::size_t>(plan.notice_size()) + problems.size(), needs.size());
  EXPECT_EQ(plan.notice(0).field(), "here");
  EXPECT_EQ(plan.notice(0).message(), "the toy backend has no mirrors (and 2 more)");
  for (const Problem& one : problems)
    EXPECT_NE(one.message.find("toy backend"), std::string::npos) << one.message;

  v1::Plan all;
  notice_unsupported(needs, {"whole backend", Features::all()}, all);
  EXPECT_EQ(all.notice_size(), 0);
  EXPECT_TRUE(refuse_unsupported(needs, {"whole backend", Features::all()}).empty());
}

TEST(Features, FactorsAreAskedForByAJob) {
  const std::string text = both + object("a", "paint");
  const RenderScene scene = test::compile_text(text);
  const v1::Settings settings = with_defaults(test::parse_scene(text).settings());
  const Capabilities none{
      .threads = 1, .backend = "toy", .features = Features::all().without({Feature::factors})};
  EXPECT_TRUE(refusals(scene, settings, none, false).empty());
  const auto problems = refusals(scene, settings, none, true);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].message, "the toy backend keeps no factors for relighting");
}

constexpr const char* soft =
    "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 2 } spectrum { standard: "
    "'E' "
    "} } light { name: 'a' sphere {} spectrum { standard: 'E' } } light { name: 'b' disk { normal "
    "{ "
    "y: 1 } } spectrum { standard: 'E' } } light { name: 'c' environment { file: 'sky.exr' } "
    "spectrum { standard: 'E' } } material { name: 'm' } object { name: 'o' material: 'm' plane {} "
    "} ";
const test::Files sky = {{"sky.exr", test::sky_file(1, 1, {{1, 1, 1}})}};

TEST(Features, OfLightsAndPlanesHaveTheirPlacesAndAreRefusedByWhoHasThemNot) {
  const RenderScene scene = test::compile_text(soft, sky);
  const v1::Settings settings = with_defaults(test::parse_scene(soft).settings());
  const Capabilities none{.threads = 1, .backend = "toy", .features = {}};
  std::vector<std::string> told;
  for (const Problem& one : refusals(scene, settings, none, false))
    told.push_back(one.field + ": " + one.message);
  EXPECT_EQ(told, (std::vector<std::string>{
                      "object[0].plane: the toy backend has no planes out to the horizon",
                      "light[1]: the toy backend has no lights with a surface",
                      "light[3]: the toy backend has no light from all around"}));
}

TEST(Features, TheFactorsOfAnEnvironmentsPictureAreNotKept) {
  const RenderScene scene = test::compile_text(soft, sky);
  const v1::Settings settings = with_defaults(test::parse_scene(soft).settings());
  const auto problems = refusals(scene, settings, {.threads = 1}, true);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].field, "light[3].environment");
}

TEST(Features, LightsWithASurfaceTakeSamplesAndThePlanSaysSo) {
  const RenderScene scene = test::compile_text(soft, sky);
  v1::Settings settings = with_defaults(test::parse_scene(soft).settings());
  EXPECT_EQ(make_plan(scene, settings, {.threads = 1}).light_samples(), 4u);
  settings.set_light_samples(9);
  const v1::Plan plan = make_plan(scene, settings, {.threads = 1});
  EXPECT_EQ(plan.light_samples(), 9u);
  const auto told = std::find_if(plan.notice().begin(), plan.notice().end(), [](const auto& one) {
    return one.message().starts_with("a pixel looks at 144 points of it");
  });
  ASSERT_NE(told, plan.notice().end());
  EXPECT_EQ(told->field(), "light[1]");
  const std::string hard = std::string(both) + object("a", "paint");
  EXPECT_EQ(make_plan(test::compile_text(hard), settings, {.threads = 1}).light_samples(), 0u);
}

}  // namespace
}  // namespace metamer
