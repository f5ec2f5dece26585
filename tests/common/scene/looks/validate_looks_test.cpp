// What is wrong with a look is told at its place, whether anybody uses it or not.
#include "common/scene/looks/validate_looks.h"

#include <gtest/gtest.h>

#include <fstream>

#include "../scene_text.h"
#include "common/scene/limits.h"
#include "common/scene/validate.h"

namespace metamer::test {
namespace {

v1::Scene scene_with(const std::string& looks) {
  SceneText text;
  text.light = "light { name: 'ceiling' position { y: 2 } spectrum { standard: 'D65' } }\n";
  auto parsed = SceneFile::parse(text.all() + looks, "s.txtpb");
  return std::move(parsed).value().scene();
}

Strings look_findings(const std::string& looks) {
  return describe(validate_looks(scene_with(looks)));
}

TEST(ValidateLooks, ASceneWithoutAnyAndOneOfNothingAreSound) {
  EXPECT_EQ(look_findings(""), Strings());
  EXPECT_EQ(look_findings("look { name: 'as it is' }"), Strings());
  EXPECT_EQ(
      look_findings("look { name: 'all' "
                    "light { name: '*' spectrum { standard: 'A' } luminance: 2 } "
                    "light { name: 'ceiling' luminance: 0 } "
                    "material { name: 'grey' diffuse { constant: 1 } specular { constant: 0 } } "
                    "observer: CIE_1931_2DEG development { rgb_space: DISPLAY_P3 } "
                    "camera { eye { z: 1 } } }"),
      Strings());
}

TEST(ValidateLooks, NamesAreGivenOnceAndOfWhatIsThere) {
  EXPECT_EQ(look_findings("look {} look { name: 'A' } look { name: 'A' }"),
            (Strings{"look[0]: look needs a name",
                     "look[2].name: look \"A\" is defined twice (first as look[1])"}));
  EXPECT_EQ(
      look_findings(
          "look { name: 'A' light { name: 'cieling' luminance: 1 } light { luminance: 1 } "
          "material { name: 'gray' diffuse { constant: 0 } } material {} }"),
      (Strings{"look[0].light[0].name: light \"cieling\" is not defined; did you mean \"ceiling\"?",
               "look[0].light[1]: a look's light needs the name of a light of the scene, or \"*\"",
               "look[0].material[0].name: material \"gray\" is not defined; did you mean \"grey\"?",
               "look[0].material[1]: a look's material needs the name of a material of the scene",
               "look[0].material[1]: a look's material needs a diffuse or a specular"}));
  EXPECT_EQ(look_findings("look { name: 'A' light { name: '*' luminance: 1 } "
                          "light { name: '*' luminance: 2 } "
                          "material { name: '*' diffuse { constant: 0 } } }"),
            (Strings{"look[0].light[1].name: \"*\" is changed twice (first by look[0].light[0])",
                     "look[0].material[0].name: material \"*\" is not defined"}));
  const std::string long_name(limits::max_name + 1, 'x');
  EXPECT_EQ(look_findings("look { name: '" + long_name + "' }"),
            Strings{"look[0].name: name is too long (201 bytes; at most 200)"});
}

TEST(ValidateLooks, WhatTheyHoldIsCheckedAsTheScenesOwn) {
  EXPECT_EQ(
      look_findings(
          "look { name: 'A' light { name: '*' spectrum { standard: 'D64' } luminance: -1 } "
          "light { name: 'ceiling' } "
          "material { name: 'grey' diffuse { constant: 1.5 } specular {} } "
          "observer: CIE_1964_10DEG observer_file: 'x.csv' "
          "development { primaries { red: 1 } } "
          "camera { vertical_fov: 180 eye { z: 1 } } }"),
      (Strings{
          "look[0].light[0].spectrum.standard: \"D64\" is not a standard illuminant; did you mean "
          "\"D65\"?",
          "look[0].light[0].luminance: luminance must not be negative (it is -1)",
          "look[0].light[1]: a look's light needs a spectrum or a luminance",
          "look[0].material[0].diffuse.constant: a property must lie in 0..1 (it is 1.5)",
          "look[0].material[0].specular: spectrum needs a standard, a file, a constant or "
          "samples",
          "look[0].observer_file: an observer_file takes the place of observer, which is given "
          "too: leave out one",
          "look[0].development.primaries.red: red must be x and y (it has 1 number)",
          "look[0].camera.vertical_fov: vertical_fov must be above 0 and below 180 degrees "
          "(it is 180)"}));
  EXPECT_EQ(look_findings("look { name: 'A' light { name: '*' luminance: nan } "
                          "camera { eye { x: inf } } }"),
            (Strings{"look[0].light[0].luminance: luminance must be finite (it is nan)",
                     "look[0].camera.eye.x: x must be finite (it is inf)"}));
  EXPECT_EQ(
      look_findings("look { name: 'A' light { name: '*' luminance: 1e31 } }"),
      Strings{"look[0].light[0].luminance: luminance must lie in 1e-30..1e+30 (it is 1e+31)"});
}

TEST(ValidateLooks, AreNoBusinessOfAServer) {
  EXPECT_EQ(validate_scene(scene_with("look { light { name: 'nobody' luminance: nan } }")).size(),
            0u);
}

TEST(ValidateLooks, ThereAreAThousandAtMost) {
  v1::Scene scene = scene_with("");
  for (std::size_t i = 0; i <= limits::max_looks; ++i)
    scene.add_look()->set_name("look " + std::to_string(i));
  EXPECT_EQ(describe(validate_looks(scene)),
            Strings{"look[1000]: a scene may have at most 1000 looks (it has 1001)"});
}

TEST(ValidateLooks, AreLocatedInTheText) {
  EXPECT_EQ(
      place_of("look { name: 'a' }\nlook {\n  light { name: '*'\n    spectrum { file: 'x' } }\n}",
               "look[1].light[0].spectrum.file"),
      "4:16");
}

TEST(LooksFiles, AreAssetsOfTheSceneAndRead) {
  const auto folder = std::filesystem::temp_directory_path() / "metamer-looks-test";
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "lamp.txt") << "400 1\n700 -2\n";
  const v1::Scene scene = scene_with(
      "look { name: 'a' light { name: '*' spectrum { file: 'lamp.txt' } } } "
      "look { name: 'b' material { name: 'grey' specular { file: 'gone.txt' } } "
      "observer_file: 'eye.csv' }");
  const auto assets = collect_assets(scene, folder);
  ASSERT_FALSE(assets);
  EXPECT_EQ(describe(assets.error()),
            (Strings{"look[1].material[0].specular.file: file \"gone.txt\" does not exist",
                     "look[1].observer_file: file \"eye.csv\" does not exist"}));
  const Strings wrong = describe(validate_spectra(
      scene, [](const std::string&) { return Result<std::string>("400 1\n700 -2\n"); }));
  ASSERT_EQ(wrong.size(), 3u);
  EXPECT_EQ(wrong[0].substr(0, 31), "look[0].light[0].spectrum.file:");
  EXPECT_EQ(wrong[2].substr(0, 22), "look[1].observer_file:");
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace metamer::test
