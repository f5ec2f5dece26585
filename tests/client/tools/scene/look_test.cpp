// A look changes what it names, and nothing else.
#include "client/tools/scene/look.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include "client/tools/scene/words.h"

namespace metamer::client {
namespace {

v1::Scene scene_from(const std::string& text) {
  v1::Scene scene;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &scene));
  return scene;
}

TEST(Look, AnEmptyOneChangesNothing) {
  v1::Scene scene = scene_from("light { name: 'a' } settings { width: 7 method { rgb {} } }");
  const v1::Scene before = scene;
  const auto replaced = apply(Look(), scene);
  ASSERT_TRUE(replaced);
  EXPECT_TRUE(replaced->empty());
  EXPECT_EQ(scene.DebugString(), before.DebugString());
}

TEST(Look, ValuesThatTheMaskDoesNotNameDoNotCount) {
  v1::Scene scene = scene_from("settings { width: 7 spp: 3 }");
  Look look;
  look.settings.set_width(9);
  look.settings.set_spp(9);
  look.set("width", "--size");
  ASSERT_TRUE(apply(look, scene));
  EXPECT_EQ(scene.settings().width(), 9u);
  EXPECT_EQ(scene.settings().spp(), 3u);
}

TEST(Look, ADefaultReplacesWhatTheSceneSays) {
  // An enumeration's first value can't be told from none in the message: the mask tells.
  v1::Scene scene = scene_from("settings { shading: QUADRATIC threads: 3 depth: 3 }");
  Look look;
  look.settings.set_depth(0);
  look.set("shading", "");
  look.set("threads", "");
  look.set("depth", "");
  ASSERT_TRUE(apply(look, scene));
  EXPECT_EQ(scene.settings().shading(), v1::PHONG);
  EXPECT_EQ(scene.settings().threads(), 0u);
  EXPECT_TRUE(scene.settings().has_depth());
  EXPECT_EQ(scene.settings().depth(), 0u);
}

TEST(Look, AMessageIsMergedAndAListReplaced) {
  v1::Scene scene = scene_from("settings { method { point { step: 2 wavelengths: [400, 500] } } }");
  Look look;
  look.settings.mutable_method()->mutable_point();
  look.mask.add_paths("method.point");
  ASSERT_TRUE(apply(look, scene));
  EXPECT_EQ(scene.settings().method().point().step(), 2);
  look.mask.clear_paths();
  look.settings.mutable_method()->mutable_point()->add_wavelengths(600);
  look.mask.add_paths("method.point.wavelengths");
  ASSERT_TRUE(apply(look, scene));
  ASSERT_EQ(scene.settings().method().point().wavelengths_size(), 1);
  EXPECT_EQ(scene.settings().method().point().wavelengths(0), 600);
}

TEST(Look, AListInAMessageThatIsMergedIsReplacedToo) {
  v1::Scene scene = scene_from("settings { method { point { step: 2 wavelengths: [400, 500] } } }");
  Look look;
  look.settings.mutable_method()->mutable_point()->add_wavelengths(555);
  look.set("method", "by hand");
  for (int i = 0; i < 2; ++i) {
    ASSERT_TRUE(apply(look, scene));
    EXPECT_EQ(scene.settings().method().point().wavelengths_size(), 1);
    EXPECT_EQ(scene.settings().method().point().step(), 2);
  }
}

TEST(Look, AMethodTakesThePlaceOfAGoalAndAGoalThatOfAMethod) {
  Look method, bases, goal;
  method.settings.mutable_method()->mutable_exact();
  method.set("method.exact", "");
  bases.settings.mutable_method()->mutable_linear()->set_bases(3);
  bases.set("method.linear.bases", "");
  goal.settings.mutable_goal()->set_deadline(2);
  goal.set("goal.deadline", "");

  for (const std::string before :
       {"goal { tolerance: 1 }", "method { auto { tolerance: 1 } }", "method { rgb {} }", ""}) {
    v1::Scene scene = scene_from("settings { " + before + " }");
    ASSERT_TRUE(apply(goal, scene));
    EXPECT_EQ(scene.settings().ShortDebugString(), "goal { deadline: 2 }") << before;
    ASSERT_TRUE(apply(method, scene));
    EXPECT_EQ(scene.settings().ShortDebugString(), "method { exact { } }") << before;
    ASSERT_TRUE(apply(goal, scene));
    ASSERT_TRUE(apply(bases, scene));
    EXPECT_EQ(scene.settings().ShortDebugString(), "method { linear { bases: 3 } }") << before;
  }

  // What changes neither leaves both as they are.
  Look other;
  other.settings.set_spp(2);
  other.set("spp", "");
  v1::Scene scene = scene_from("settings { goal { tolerance: 1 } }");
  ASSERT_TRUE(apply(other, scene));
  EXPECT_EQ(scene.settings().goal().tolerance(), 1);
}

TEST(Look, GivesLightsOtherSpectra) {
  v1::Scene scene =
      scene_from("light { name: 'lamp' spectrum { file: 'x' entry: 'y' } } light { name: 'sun' }");
  Look look;
  look.lights.push_back({.light = {}, .by = "all"});
  look.lights.back().light.set_name("*");
  look.lights.back().light.mutable_spectrum()->set_standard("A");
  look.lights.push_back({.light = {}, .by = "one"});
  look.lights.back().light.set_name("sun");
  look.lights.back().light.mutable_spectrum()->set_standard("D65");
  const auto replaced = apply(look, scene);
  ASSERT_TRUE(replaced);
  EXPECT_EQ(scene.light(0).spectrum().ShortDebugString(), "standard: \"A\"");
  EXPECT_EQ(scene.light(1).spectrum().standard(), "D65");
  ASSERT_EQ(replaced->size(), 3u);
  EXPECT_EQ(replaced_by(*replaced, "light[0].spectrum.standard"), "all");
  EXPECT_EQ(replaced_by(*replaced, "light[10].spectrum"), "");

  look.lights.back().light.set_name("sin");
  const auto unknown = apply(look, scene);
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().message, "no light named \"sin\"; did you mean \"sun\"?");
}

TEST(Look, ASpectrumForAllLightsPassesOverASkyUnlessThereIsNothingElse) {
  Look look;
  look.lights.push_back({.light = {}, .by = "all"});
  look.lights.back().light.set_name("*");
  look.lights.back().light.mutable_spectrum()->set_standard("A");
  look.lights.back().light.set_luminance(0.5);
  const std::string sky = "light { name: 'sky' environment { sky {} } }";
  v1::Scene scene = scene_from(sky + " light { name: 'sun' }");
  ASSERT_TRUE(apply(look, scene));
  EXPECT_FALSE(scene.light(0).has_spectrum());
  EXPECT_EQ(scene.light(0).luminance(), 0.5);
  EXPECT_EQ(scene.light(1).spectrum().standard(), "A");

  scene = scene_from(sky);
  const auto replaced = apply(look, scene);
  ASSERT_TRUE(replaced);
  EXPECT_TRUE(scene.light(0).has_spectrum());  // What is wrong there is the option's.
  EXPECT_EQ(replaced_by(*replaced, "light[0].spectrum"), "all");
}

TEST(Look, AFieldBelongsToWhatReplacedItOrWhatItLiesIn) {
  const std::vector<Replaced> replaced = {{"settings.method", "--samples"}, {"settings.spp", "S"}};
  EXPECT_EQ(replaced_by(replaced, "settings.method.point.wavelengths[3]"), "--samples");
  EXPECT_EQ(replaced_by(replaced, "settings.spp"), "S");
  EXPECT_EQ(replaced_by(replaced, "settings.spp_of_another_kind"), "");
  EXPECT_EQ(replaced_by(replaced, "settings"), "");
}

TEST(Words, NameEveryValueOfAnEnumeration) {
  for (const google::protobuf::EnumDescriptor* type :
       {v1::Observer_descriptor(), v1::Backend_descriptor(), v1::Shading_descriptor()})
    for (int i = 0; i < type->value_count(); ++i) {
      const auto value = value_named(word_of(*type->value(i)), "value", *type);
      ASSERT_TRUE(value);
      EXPECT_EQ(*value, type->value(i)->number());
    }
  EXPECT_EQ(observer_named("cie-1964-10deg"), v1::CIE_1964_10DEG);
  EXPECT_EQ(adaptation_named("none"), v1::NO_ADAPTATION);
  EXPECT_EQ(rgb_space_named("display-p3"), v1::DISPLAY_P3);
}

TEST(Words, SayWhatWasPerhapsMeant) {
  const auto& backends = *v1::Backend_descriptor();
  EXPECT_EQ(value_named("software", "backend", backends).error().message,
            "no backend named \"software\"; there are cpu, gl");
  EXPECT_EQ(adaptation_named("bradfort").error().message,
            "no adaptation named \"bradfort\"; did you mean \"bradford\"?");
  EXPECT_EQ(observer_named("").error().message,
            "no observer named \"\"; there are cie-1931-2deg, cie-1964-10deg");
}

}  // namespace
}  // namespace metamer::client
