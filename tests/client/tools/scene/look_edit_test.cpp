// A look that is written into a scene's text and read back makes of it what it made before.
#include "client/tools/scene/look_edit.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include "client/tools/scene/look_change.h"
#include "client/tools/scene/settings_change.h"
#include "client/tools/scene/text_fields.h"
#include "common/scene/looks/validate_looks.h"

namespace metamer::client {
namespace {

const std::string plain_body = R"(# Camera.
camera { eye { z: 4 } } # in front
light { name: "key" spectrum { standard: "D65" } luminance: 0.5 } light { name: "fill" }
material { name: "m" diffuse { constant: 0.5 } } material { name: "n" }
object { name: "o" material: "m" }
)";

/// A text, and what is written into it: one for each way that a text can have looks and settings.
const std::vector<std::string> edited_texts{
    plain_body,
    plain_body + "# no newline at the end",
    plain_body + R"(settings { spp: 4 observer_file: "eye.csv" })",
    plain_body + "settings <spp: 4, goal { tolerance: 1 }; depth: 2 # deep }\n\t>\n",
    plain_body +
        "settings {\n\tspp: 4 # few\n\tmethod { auto { deadline: 3 } } # old\n\tthreads: 2;\n}\n",
    plain_body + "settings { development { linear: true adaptation: SHARP } }\n# end\n",
    R"(look { name: "a" } # first
look: { # taken
	name: "mine" # the name
} # behind
)" + plain_body,
    R"(look [ { name: "a" }, { name: "mine" observer: CIE_1964_10DEG }, <name: "c">] # list
look { name: "d" })" +
        plain_body};

v1::Scene scene_in(const std::string& text) {
  v1::Scene scene;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &scene)) << text;
  return scene;
}

std::string shown_under(const Look& look, v1::Scene scene) {
  EXPECT_TRUE(apply(look, scene));
  scene.clear_look();
  return scene.DebugString();
}

std::string with_look(const std::string& text, const Look& look, const std::string& name) {
  const auto edit = look_edit(text, look, name);
  if (!edit) {
    ADD_FAILURE() << edit.error().message;
    return text;
  }
  EXPECT_LE(edit->begin, edit->end);
  EXPECT_LE(edit->end, text.size());
  return text.substr(0, edit->begin) + edit->text + text.substr(edit->end);
}

v1::LookLight light_change(const std::string& name, const char* standard, double luminance) {
  v1::LookLight light;
  light.set_name(name);
  if (standard != nullptr) light.mutable_spectrum()->set_standard(standard);
  if (luminance > 0) light.set_luminance(luminance);
  return light;
}

/// What hands do: light and paint over each other, a camera, and each setting set and taken away.
std::vector<Look> looks_by_hand(const v1::Scene& scene) {
  std::vector<Look> looks{{}};
  Look lit;
  set_light(light_change("key", "A", 0.25), lit);
  set_light(light_change("key", "F11", 0), lit);
  set_light(light_change("*", nullptr, 2), lit);
  set_light(light_change("*", "E", 0), lit);
  set_light(light_change("fill", nullptr, 0.125), lit);
  looks.push_back(lit);
  Look painted;
  v1::LookMaterial paint;
  paint.set_name("m");
  paint.mutable_diffuse()->set_constant(0.1);
  set_material(paint, painted);
  paint.clear_diffuse();
  paint.mutable_specular()->set_constant(1.0 / 3);
  set_material(paint, painted);
  painted.camera.emplace();
  painted.camera->mutable_eye()->set_x(0.1 + 0.2);
  looks.push_back(painted);
  const char* const settings[] = {"spp: 64 width: 10 height: 8 depth: 1 threads: 3 tile_size: 32",
                                  "shading: GOURAUD backend: GL verify: true",
                                  "method { point { wavelengths: [400, 555.5, 700] } }",
                                  "goal { deadline: 1 }",
                                  "observer: CIE_1964_10DEG",
                                  "observer_file: \"mine \\\"é\\\".csv\"",
                                  "development { adaptation: BRADFORD rgb_space: ADOBE_RGB }",
                                  "development { linear: true }",
                                  ""};
  for (const char* text : settings) {
    v1::Settings wanted;
    EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &wanted));
    Look look;
    set_settings(scene.settings(), wanted, "by hand", look);
    looks.push_back(look);
    v1::Settings merged = scene.settings();
    merged.MergeFrom(wanted);
    if (merged.has_goal() && wanted.has_method()) merged.clear_goal();
    if (merged.has_goal()) merged.clear_method();
    if (wanted.observer() != v1::CIE_1931_2DEG) merged.clear_observer_file();
    Look both = lit;
    set_settings(scene.settings(), merged, "by hand", both);
    looks.push_back(both);
  }
  return looks;
}

TEST(LookEdit, TheTextReadBackUnderItsLookIsTheSceneThatWasShown) {
  for (const std::string& text : edited_texts) {
    const v1::Scene scene = scene_in(text);
    for (const Look& look : looks_by_hand(scene))
      for (const char* name : {"mine", "shop & \"home\"", "c"}) {
        const std::string after = with_look(text, look, name);
        const v1::Scene read = scene_in(after);
        const auto chosen = choose_look({}, read, name);
        ASSERT_TRUE(chosen) << after;
        EXPECT_EQ(shown_under(*chosen, read), shown_under(look, scene)) << after;
        EXPECT_EQ(validate_looks(read).size(), 0u) << after << validate_looks(read)[0].message;
        EXPECT_EQ(with_look(after, look, name), after) << "written twice, it is the same";
      }
  }
}

TEST(LookEdit, CommentsAndAllOtherLooksStay) {
  for (const std::string& text : edited_texts) {
    const v1::Scene scene = scene_in(text);
    for (const Look& look : looks_by_hand(scene)) {
      const std::string after = with_look(text, look, "new");
      std::size_t at = 0;
      for (std::size_t hash = text.find('#'); hash != std::string::npos;
           hash = text.find('#', hash + 1)) {
        const std::string comment = text.substr(hash, text.find('\n', hash) - hash);
        at = after.find(comment, at);
        ASSERT_NE(at, std::string::npos) << comment << "\n" << after;
        at += comment.size();
      }
      const v1::Scene read = scene_in(after);
      ASSERT_EQ(read.look_size(), scene.look_size() + 1);
      for (int i = 0; i < scene.look_size(); ++i)
        EXPECT_EQ(read.look(i).DebugString(), scene.look(i).DebugString());
    }
  }
}

TEST(LookEdit, ALookOfThatNameIsReplacedInItsPlace) {
  Look look;
  set_light(light_change("*", "A", 0), look);
  EXPECT_EQ(with_look("look { name: \"one\" } # 1\nlook { name: \"two\" }\nlight { name: \"l\" }\n",
                      look, "one"),
            "look { name: \"one\" light { name: \"*\" spectrum { standard: \"A\" } } } # 1\n"
            "look { name: \"two\" }\nlight { name: \"l\" }\n");
}

TEST(LookEdit, ATextWithoutLooksGetsThoseThatStoodInTheirPlace) {
  v1::Scene shown = scene_in(plain_body);
  add_standard_looks(shown);
  const auto edit = look_edit(plain_body, {}, "A", shown.look());
  ASSERT_TRUE(edit);
  const v1::Scene read = scene_in(plain_body.substr(0, edit->begin) + edit->text);
  ASSERT_EQ(read.look_size(), 3);
  EXPECT_EQ(read.look(1).name(), "A");
  EXPECT_EQ(read.look(1).light_size(), 0);
  EXPECT_EQ(read.look(2).light(0).spectrum().standard(), "F11");
}

TEST(LookEdit, WhatCanNotBeReadAndWhatDoesNotFitAreErrors) {
  EXPECT_FALSE(look_edit("camera {", {}, "x"));
  Look look;
  set_light(light_change("of another scene", "A", 0), look);
  EXPECT_FALSE(look_edit(plain_body, look, "x"));
}

TEST(TextFields, AreFoundByTheirBytesBehindTabsCommentsAndLists) {
  const std::string text =
      "\ta: -1.5 # a { b\n\tname:\t\"x\" 'y\\'', list: [1, 2];\tm { n < o: \"}\" > } p [{ q: 1 }, "
      "<>]";
  std::vector<std::string> found;
  for (const TextField& field : text_fields(text)) {
    found.push_back(text.substr(field.span.begin, field.span.end - field.span.begin));
    for (const TextSpan& value : field.values)
      found.push_back("  " + text.substr(value.begin, value.end - value.begin));
    if (field.next != field.span.end) found.push_back(text.substr(field.next - 1, 1));
  }
  const std::vector<std::string> expected{"a: -1.5",
                                          "  -1.5",
                                          "name:\t\"x\" 'y\\''",
                                          "  \"x\" 'y\\''",
                                          ",",
                                          "list: [1, 2]",
                                          "  1",
                                          "  2",
                                          ";",
                                          "m { n < o: \"}\" > }",
                                          "  { n < o: \"}\" > }",
                                          "p [{ q: 1 }, <>]",
                                          "  { q: 1 }",
                                          "  <>"};
  EXPECT_EQ(found, expected);
}

}  // namespace
}  // namespace metamer::client
