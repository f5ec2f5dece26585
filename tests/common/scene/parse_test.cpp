#include <gtest/gtest.h>

#include <fstream>

#include "common/scene/scene_file.h"
#include "common/scene/validate.h"
#include "scene_text.h"

namespace metamer::test {
namespace {

TEST(SceneParse, TheExampleOfTheDocumentationIsSound) {
  const auto file = SceneFile::read(METAMER_TEST_DATA "/scenes/example.txtpb");
  ASSERT_TRUE(file) << format(file.error());
  EXPECT_EQ(describe(validate_scene(file->scene())), Strings());
  EXPECT_EQ(file->scene().material(0).name(), "tcs09");
  EXPECT_EQ(file->scene().settings().method().point().step(), 5);

  const auto assets = collect_assets(file->scene(), METAMER_TEST_DATA "/scenes");
  ASSERT_TRUE(assets);
  ASSERT_EQ(assets->size(), 1u);
  EXPECT_EQ((*assets)[0].name, "spectra/tcs.sp");
  EXPECT_EQ((*assets)[0].field, "material[0].diffuse.file");
}

TEST(SceneParse, UnknownFieldStandsAtItsNameAndOffersTheNearest) {
  EXPECT_EQ(parse_error("light {\n  lumnance: 1\n}\n"),
            "s.txtpb:2:3: error: Light has no field \"lumnance\"; did you mean \"luminance\"?\n"
            "  lumnance: 1\n"
            "  ^");
}

TEST(SceneParse, UnknownFieldFarFromAllListsThem) {
  EXPECT_EQ(parse_error("object { sphere { diameter: 1 } }"),
            "s.txtpb:1:19: error: Sphere has no field \"diameter\"; its fields: center, radius\n"
            "object { sphere { diameter: 1 } }\n"
            "                  ^");
  EXPECT_EQ(parse_error("settings { method { rgb { gamma: 1 } } }"),
            "s.txtpb:1:27: error: Rgb has no field \"gamma\"; it has none\n"
            "settings { method { rgb { gamma: 1 } } }\n"
            "                          ^");
}

TEST(SceneParse, UnknownFieldIsFoundBehindCommentsThatNameIt) {
  EXPECT_EQ(parse_error("lihgt # lihgt, lihgt\n{ }"),
            "s.txtpb:1:1: error: Scene has no field \"lihgt\"; did you mean \"light\"?\n"
            "lihgt # lihgt, lihgt\n"
            "^");
}

TEST(SceneParse, CaretStaysUnderTheNameBehindTabsAndUmlauts) {
  EXPECT_EQ(parse_error("light {\n\tname: \"Büro\"\tlumnance: 1\n}\n"),
            "s.txtpb:2:16: error: Light has no field \"lumnance\"; did you mean \"luminance\"?\n"
            "\tname: \"Büro\"\tlumnance: 1\n"
            "\t            \t^");
}

TEST(SceneParse, UnknownEnumValueListsTheValues) {
  EXPECT_EQ(parse_error("settings { observer: CIE_1931_2DGE }"),
            "s.txtpb:1:22: error: observer has no value \"CIE_1931_2DGE\" (its values: "
            "CIE_1931_2DEG, CIE_1964_10DEG); did you mean \"CIE_1931_2DEG\"?\n"
            "settings { observer: CIE_1931_2DGE }\n"
            "                     ^");
}

TEST(SceneParse, WhatIsGivenTwiceStandsAtTheSecond) {
  EXPECT_EQ(parse_error("settings { width: 4 width: 5 }"),
            "s.txtpb:1:21: error: width is given twice\n"
            "settings { width: 4 width: 5 }\n"
            "                    ^");
  EXPECT_EQ(parse_error("light { position { } direction { } }"),
            "s.txtpb:1:22: error: direction can't be given together with position\n"
            "light { position { } direction { } }\n"
            "                     ^");
}

TEST(SceneParse, SyntaxErrorsSayWhatWasExpectedAndFound) {
  EXPECT_EQ(parse_error("camera { vertical_fov: wide }"),
            "s.txtpb:1:24: error: expected a number, found \"wide\"\n"
            "camera { vertical_fov: wide }\n"
            "                       ^");
  EXPECT_EQ(parse_error("camera { vertical_fov: 0x20 }"),
            "s.txtpb:1:24: error: expected a decimal number, found \"0x20\"\n"
            "camera { vertical_fov: 0x20 }\n"
            "                       ^");
  EXPECT_EQ(parse_error("settings { width: 6.5 }"),
            "s.txtpb:1:19: error: expected a whole number, found \"6.5\"\n"
            "settings { width: 6.5 }\n"
            "                  ^");
  EXPECT_EQ(parse_error("settings { width: -5 }"),
            "s.txtpb:1:19: error: expected a whole number, found \"-\"\n"
            "settings { width: -5 }\n"
            "                  ^");
  EXPECT_EQ(parse_error("settings { width: 99999999999 }"),
            "s.txtpb:1:19: error: 99999999999 is too large\n"
            "settings { width: 99999999999 }\n"
            "                  ^");
  EXPECT_EQ(parse_error("light { name: ceiling }"),
            "s.txtpb:1:15: error: expected text in quotes, found \"ceiling\"\n"
            "light { name: ceiling }\n"
            "              ^");
  EXPECT_EQ(parse_error("camera { eye { y: 1 }"),
            "s.txtpb:1:22: error: expected a field's name, found the end of the file\n"
            "camera { eye { y: 1 }\n"
            "                     ^");
  EXPECT_EQ(parse_error("camera 5"),
            "s.txtpb:1:8: error: expected \"{\", found \"5\"\n"
            "camera 5\n"
            "       ^");
}

TEST(SceneParse, ANumberInASpectrumsPlaceIsAConstant) {
  EXPECT_EQ(
      parse_error("material { fresnel { dielectric { n: 1.5 } } }"),
      "s.txtpb:1:38: error: expected \"{\", found \"1.5\"; a spectrum is meant: { constant: 1.5 "
      "}\n"
      "material { fresnel { dielectric { n: 1.5 } } }\n"
      "                                     ^");
  EXPECT_EQ(
      parse_error("material { diffuse: 'red.csv' }"),
      "s.txtpb:1:21: error: expected \"{\", found \"'red.csv'\"; a spectrum is meant: { file: "
      "'red.csv' }\n"
      "material { diffuse: 'red.csv' }\n"
      "                    ^");
  const auto scene = SceneFile::parse("material { fresnel { dielectric { n: 1.5 } } }", "s.txtpb");
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().was, "1.5");
  EXPECT_EQ(scene.error().meant, "{ constant: 1.5 }");
  EXPECT_TRUE(
      SceneFile::parse("material { fresnel { dielectric { n: { constant: 1.5 } } } }", "s.txtpb"));
}

TEST(SceneParse, BrokenStringsAndControlCharactersAreErrors) {
  EXPECT_EQ(parse_error("light { name: \"ceil\n }"),
            "s.txtpb:1:20: error: string literals cannot cross line boundaries\n"
            "light { name: \"ceil\n"
            "                   ^");
  EXPECT_EQ(parse_error(std::string("light {\0}", 9)).substr(0, 72),
            "s.txtpb:1:8: error: invalid control characters encountered in text\nlight");
}

TEST(SceneParse, EmptyTextIsASceneWithoutAnything) {
  EXPECT_EQ(parse_error(""), "");
  EXPECT_EQ(text_findings(""),
            Strings({"camera: the scene needs a camera", "light: the scene needs a light",
                     "object: the scene needs an object"}));
}

TEST(SceneParse, TextOverTheLimitIsRefused) {
  EXPECT_EQ(parse_error(std::string(max_scene_text + 1, ' ')),
            "s.txtpb: error: file is too large (16777217 bytes; at most 16777216)");
}

TEST(SceneRead, FilesThatAreNoneAreNamed) {
  const auto error = [](const std::string& file) {
    const auto scene = SceneFile::read(file);
    return scene ? std::string() : format(scene.error());
  };
  EXPECT_EQ(error("no/such.txtpb"), "no/such.txtpb: error: file does not exist");
  EXPECT_EQ(error("/usr"), "/usr: error: file is a folder");
  EXPECT_EQ(error("/dev/null"), "/dev/null: error: file is not a regular file");
}

}  // namespace
}  // namespace metamer::test
