#include "server/plan/features.h"

#include <gtest/gtest.h>

#include "common/scene/settings.h"
#include "server/plan/plan.h"
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
  EXPECT_EQ(feature_names().size(), static_cast<std::size_t>(Feature::transmission) + 1);
  for (std::size_t i = 0; i < feature_names().size(); ++i)
    EXPECT_TRUE(Features::all().has(static_cast<Feature>(i))) << feature_names()[i];
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
  EXPECT_EQ(needs[1].feature, Feature::exact_fresnel);
  EXPECT_EQ(needs[2].feature, Feature::anisotropy);
  for (const Need& need : needs) {
    EXPECT_EQ(need.field, "object[1]");
    EXPECT_EQ(need.count, 2u);
  }
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

}  // namespace
}  // namespace metamer
