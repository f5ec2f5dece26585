// A look that is changed control by control says each thing once, and forgets the look before.
#include "client/tools/scene/look_change.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include "common/scene/looks/validate_looks.h"

namespace metamer::client {
namespace {

v1::Scene looked_scene(const std::string& looks) {
  v1::Scene scene;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(
      R"(camera { eye { z: 4 } }
      light { name: "key" spectrum { standard: "D65" } luminance: 0.5 } light { name: "fill" }
      material { name: "m" diffuse { constant: 0.5 } } material { name: "n" }
      object { name: "o" material: "m" } settings { spp: 4 observer_file: "eye.csv" })" +
          looks,
      &scene));
  return scene;
}

const char* const three_looks = R"(
  look { name: "all A" light { name: "*" spectrum { standard: "A" } } }
  look { name: "fill F2" light { name: "fill" spectrum { standard: "F2" } luminance: 0.3 } }
  look { name: "eye" observer: CIE_1964_10DEG camera { eye { x: 3 } }
    material { name: "m" diffuse { constant: 0.1 } } development { adaptation: BRADFORD } })";

v1::LookLight look_light(const std::string& name, const std::string& standard) {
  v1::LookLight light;
  light.set_name(name);
  light.mutable_spectrum()->set_standard(standard);
  return light;
}

v1::LookMaterial look_paint(const std::string& name, double value) {
  v1::LookMaterial material;
  material.set_name(name);
  material.mutable_diffuse()->set_constant(value);
  return material;
}

std::string with_changes(const Look& look, v1::Scene scene) {
  const auto done = apply(look, scene);
  EXPECT_TRUE(done);
  scene.clear_look();
  return scene.DebugString();
}

Look choosing(const Look& now, const v1::Scene& scene, const std::string& name) {
  const auto look = choose_look(now, scene, name);
  EXPECT_TRUE(look) << name;
  return look.value_or(Look{});
}

TEST(LookChange, OfALookThatIsChosenWhatWasChosenBeforeDoesNotMatter) {
  const v1::Scene scene = looked_scene(three_looks);
  for (const v1::Look& first : scene.look())
    for (const v1::Look& second : scene.look()) {
      const Look direct = choosing({}, scene, second.name());
      const Look after = choosing(choosing({}, scene, first.name()), scene, second.name());
      EXPECT_EQ(with_changes(after, scene), with_changes(direct, scene))
          << second.name() << " after " << first.name();
      EXPECT_TRUE(look_alike(after, direct, scene));
    }
}

TEST(LookChange, ALookTakesThePlaceOfWhatWasSetByHandOfItsKindAndLeavesTheRest) {
  const v1::Scene scene = looked_scene(three_looks);
  Look look;
  set_light(look_light("key", "F11"), look);
  set_material(look_paint("m", 0.2), look);
  set_material(look_paint("n", 0.3), look);
  v1::Settings settings;
  settings.set_backend(v1::GL);
  set_setting("backend", settings, look);

  v1::Scene lit = scene;
  ASSERT_TRUE(apply(choosing(look, scene, "all A"), lit));
  EXPECT_EQ(lit.light(0).spectrum().standard(), "A");
  EXPECT_EQ(lit.material(0).diffuse().constant(), 0.2);
  EXPECT_EQ(lit.settings().backend(), v1::GL);

  v1::Scene painted = scene;
  ASSERT_TRUE(apply(choosing(look, scene, "eye"), painted));
  EXPECT_EQ(painted.light(0).spectrum().standard(), "F11");
  EXPECT_EQ(painted.material(0).diffuse().constant(), 0.1);
  EXPECT_EQ(painted.material(1).diffuse().constant(), 0.3);
  EXPECT_EQ(painted.settings().observer(), v1::CIE_1964_10DEG);
  EXPECT_EQ(painted.settings().observer_file(), "");
  EXPECT_EQ(painted.settings().spp(), 4u);
  EXPECT_EQ(painted.camera().eye().x(), 3);
}

TEST(LookChange, WithoutALookTheSceneIsItsOwnButForItsDevice) {
  const v1::Scene scene = looked_scene(three_looks);
  Look look = choosing({}, scene, "eye");
  set_light(look_light("*", "E"), look);
  EXPECT_EQ(with_changes(without_look(look), scene), with_changes({}, scene));
  v1::Settings settings;
  settings.set_backend(v1::GL);
  set_setting("backend", settings, look);
  v1::Scene expected = scene;
  expected.mutable_settings()->set_backend(v1::GL);
  EXPECT_EQ(with_changes(without_look(look), scene), with_changes({}, expected));
}

TEST(LookChange, EachThingIsSaidOnceHoweverOftenItIsSet) {
  Look look;
  for (int i = 0; i < 50; ++i) {
    set_light(look_light("key", i % 2 == 0 ? "A" : "E"), look);
    set_material(look_paint("m", i / 50.0), look);
    v1::Settings settings;
    settings.mutable_development()->set_adaptation(i % 2 == 0 ? v1::BRADFORD : v1::NO_ADAPTATION);
    set_setting("development.adaptation", settings, look);
  }
  EXPECT_EQ(look.lights.size(), 1u);
  EXPECT_EQ(look.materials.size(), 1u);
  EXPECT_EQ(look.mask.paths_size(), 1);
  EXPECT_EQ(look.replaced.size(), 1u);
  v1::Scene scene = looked_scene("");
  ASSERT_TRUE(apply(look, scene));
  EXPECT_EQ(scene.settings().development().adaptation(), v1::NO_ADAPTATION);
  set_light(look_light("*", "F2"), look);
  EXPECT_EQ(look.lights.size(), 1u) << "all lights: nothing of one alone is left";
}

TEST(LookChange, ALuminanceStaysWhereOnlyTheSpectrumIsSet) {
  const v1::Scene scene = looked_scene(three_looks);
  Look look = choosing({}, scene, "fill F2");
  set_light(look_light("*", "A"), look);
  v1::Scene lit = scene;
  ASSERT_TRUE(apply(look, lit));
  EXPECT_EQ(lit.light(1).spectrum().standard(), "A");
  EXPECT_EQ(lit.light(1).luminance(), 0.3);
}

TEST(LookChange, WhatASceneKeepsOfALookMakesTheSameOfIt) {
  v1::Scene scene = looked_scene(three_looks);
  Look look = choosing({}, scene, "eye");
  set_light(look_light("*", "F11"), look);
  set_light(look_light("key", "A"), look);
  set_material(look_paint("n", 0.7), look);
  *scene.add_look() = to_message(look, "kept");
  EXPECT_EQ(with_changes(choosing({}, scene, "kept"), scene), with_changes(look, scene));
}

TEST(LookChange, WhatASceneKeepsOfALookChangesEachNameOnce) {
  v1::Scene scene = looked_scene("");
  v1::LookLight dimmed;
  dimmed.set_name("key");
  dimmed.set_luminance(0.25);
  Look look;
  set_light(dimmed, look);
  set_light(look_light("*", "F11"), look);
  set_light(look_light("key", "A"), look);
  dimmed.set_name("*");
  dimmed.set_luminance(2);
  set_light(dimmed, look);
  set_material(look_paint("m", 0.2), look);
  *scene.add_look() = to_message(look, "kept");
  EXPECT_EQ(validate_looks(scene).size(), 0u);
  EXPECT_EQ(scene.look(0).light_size(), 2);
  EXPECT_EQ(with_changes(choosing({}, scene, "kept"), scene), with_changes(look, scene));
}

TEST(LookChange, LooksThatDoNotFitTheSceneAreNotAlike) {
  Look look;
  set_light(look_light("of another scene", "A"), look);
  EXPECT_FALSE(look_alike(look, look, looked_scene("")));
}

TEST(LookChange, TheStandardOnesAreSoundLooksOfAnyScene) {
  v1::Scene scene = looked_scene("");
  add_standard_looks(scene);
  ASSERT_GT(scene.look_size(), 1);
  for (const v1::Look& look : scene.look()) {
    v1::Scene lit = scene;
    ASSERT_TRUE(apply(choosing({}, scene, look.name()), lit));
    for (const v1::Light& light : lit.light()) EXPECT_EQ(light.spectrum().standard(), look.name());
  }
}

v1::Settings method_settings(const std::string& text) {
  v1::Settings settings;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &settings)) << text;
  return settings;
}

TEST(LookChange, AMethodOrAGoalIsWhatWasChosenLastWhateverTheSceneSays) {
  const char* const choices[] = {"method { exact {} }",
                                 "method { linear { bases: 4 } }",
                                 "method { linear { bases: 7 bounce: true weighting: OBSERVER } }",
                                 "method { point { fitted: 8 } }",
                                 "method { point { from: 400 to: 700 step: 5 } }",
                                 "method { rgb {} }",
                                 "goal { tolerance: 0.2 }",
                                 "goal { deadline: 3 }"};
  for (const std::string own :
       {"", choices[1], choices[2], choices[4], choices[6], "method { auto { tolerance: 0.3 } }"})
    for (const char* first : choices)
      for (const char* second : choices) {
        v1::Scene scene = looked_scene(three_looks);
        scene.mutable_settings()->MergeFrom(method_settings(own));
        const v1::Settings settings = scene.settings();
        Look look = choosing({}, scene, "eye");
        const std::string without = with_changes(look, looked_scene(three_looks));
        set_method(settings, method_settings(first), look);
        set_method(settings, method_settings(second), look);
        ASSERT_TRUE(apply(look, scene));
        v1::Settings shown;
        if (scene.settings().has_method()) *shown.mutable_method() = scene.settings().method();
        if (scene.settings().has_goal()) *shown.mutable_goal() = scene.settings().goal();
        EXPECT_EQ(shown.DebugString(), method_settings(second).DebugString())
            << own << ", then " << first;
        scene.mutable_settings()->clear_method();
        scene.mutable_settings()->clear_goal();
        scene.clear_look();
        EXPECT_EQ(scene.DebugString(), without) << "nothing else changes";
      }
}

}  // namespace
}  // namespace metamer::client
