// Other light and paint for a kept picture.
#include "client/tools/pictures/relit.h"

#include <gtest/gtest.h>

namespace metamer::client {
namespace {

v1::SceneFactors scene_of(const std::vector<std::string>& lights,
                          const std::vector<std::string>& materials) {
  v1::SceneFactors scene;
  for (const std::string& name : lights) {
    scene.add_light()->set_name(name);
    scene.mutable_light()->rbegin()->set_luminance(1);
  }
  for (const std::string& name : materials) scene.add_material()->set_name(name);
  return scene;
}

std::vector<double> values(const v1::SampledSpectrum& spectrum) {
  return {spectrum.values().begin(), spectrum.values().end()};
}

TEST(Relit, APropertyIsNamedWithOrWithoutWhatItIs) {
  const auto properties = properties_of(scene_of({}, {"wall", "door"}));
  EXPECT_EQ(properties.size(), 6u);
  EXPECT_EQ(properties.at("door").material, 1);
  EXPECT_EQ(properties.at("door").term, v1::FACTOR_DIFFUSE);
  EXPECT_EQ(properties.at("door.specular").term, v1::FACTOR_SPECULAR);
  EXPECT_EQ(properties.at("wall.diffuse").material, 0);
}

TEST(Relit, AMaterialsOwnNameGoesBeforeAProperty) {
  const auto properties = properties_of(scene_of({}, {"door.specular", "door", ""}));
  EXPECT_EQ(properties.at("door.specular").material, 0);
  EXPECT_EQ(properties.at("door.specular").term, v1::FACTOR_DIFFUSE);
  EXPECT_EQ(properties.at("").material, 2);
}

TEST(Relit, IsShownInTheLastSurfaceOrInAMirror) {
  v1::TileFactors tables;
  EXPECT_FALSE(is_shown({0, v1::FACTOR_DIFFUSE}, tables));
  tables.add_signature_material(3);
  tables.add_signature_term(v1::FACTOR_DIFFUSE);
  tables.add_product_material(5);
  tables.add_product_term(v1::FACTOR_SPECULAR);
  EXPECT_TRUE(is_shown({3, v1::FACTOR_DIFFUSE}, tables));
  EXPECT_FALSE(is_shown({3, v1::FACTOR_SPECULAR}, tables));
  EXPECT_TRUE(is_shown({5, v1::FACTOR_SPECULAR}, tables));
  EXPECT_FALSE(is_shown({5, v1::FACTOR_DIFFUSE}, tables));
}

TEST(Relit, SwapsTheLightsThatAreNamed) {
  v1::SceneFactors scene = scene_of({"key", "fill", "key"}, {});
  swap_light("key", {{400, 700}, {1, 2}}, scene);
  EXPECT_EQ(values(scene.light(0).power()), (std::vector<double>{1, 2}));
  EXPECT_EQ(values(scene.light(1).power()), std::vector<double>{});
  EXPECT_EQ(values(scene.light(2).power()), (std::vector<double>{1, 2}));
  swap_light("*", {{500}, {3}}, scene);
  for (const auto& light : scene.light()) EXPECT_EQ(values(light.power()), std::vector<double>{3});
  swap_light("none", {{500}, {4}}, scene);
  EXPECT_EQ(values(scene.light(0).power()), std::vector<double>{3});
}

TEST(Relit, SwapsOneReflectanceAndLeavesTheOther) {
  v1::SceneFactors scene = scene_of({}, {"wall", "door"});
  swap_reflectance({1, v1::FACTOR_SPECULAR}, {{500}, {0.5}}, scene);
  EXPECT_EQ(values(scene.material(1).specular()), std::vector<double>{0.5});
  EXPECT_FALSE(scene.material(1).has_diffuse());
  EXPECT_FALSE(scene.material(0).has_specular());
}

TEST(Relit, ThePlanHasTheWhiteOfTheFirstLight) {
  v1::SceneFactors scene = scene_of({"sun", "lamp"}, {});
  swap_light("sun", {{360, 830}, {1, 1}}, scene);
  swap_light("lamp", {{700}, {1}}, scene);
  v1::Plan plan;
  plan.mutable_method()->mutable_rgb();
  plan.add_source_white(7);
  plan_relit(scene, plan);
  EXPECT_TRUE(plan.method().has_exact());
  ASSERT_EQ(plan.source_white_size(), 3);
  // The equal-energy stimulus has x = y = 1/3.
  for (const double value : plan.source_white()) EXPECT_NEAR(value, 1, 5e-4);
}

TEST(Relit, WhatNobodySeesHasNoWhite) {
  v1::SceneFactors scene = scene_of({"heat"}, {});
  swap_light("*", {{900, 1000}, {1, 1}}, scene);
  v1::Plan plan;
  plan.add_source_white(1);
  plan_relit(scene, plan);
  EXPECT_EQ(plan.source_white_size(), 0);
  v1::Plan of_none;
  plan_relit({}, of_none);
  EXPECT_EQ(of_none.source_white_size(), 0);
}

}  // namespace
}  // namespace metamer::client
