// Options in place of the scene's settings.
#include "client/cli/overrides.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

namespace metamer::cli {
namespace {

using client::replaced_by;

v1::Scene scene_from(const std::string& text) {
  v1::Scene scene;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &scene));
  return scene;
}

std::string error_of(const Overrides& overrides, v1::Scene scene = {}) {
  const auto applied = apply(overrides, scene);
  return applied ? "" : applied.error().message;
}

TEST(Overrides, ALightThatLaterOnesTakeAllOfIsRefused) {
  const v1::Scene lamp = scene_from("light { name: 'lamp' }");
  const v1::Scene two = scene_from("light { name: 'lamp' } light { name: 'sun' }");
  Overrides overrides;
  overrides.lights = {"*=A", "lamp=D65"};
  EXPECT_EQ(error_of(overrides, two), "");
  EXPECT_EQ(error_of(overrides, lamp),
            "--light: \"*\" has no effect: after it each light is named by itself");
  overrides.lights = {"lamp=D65", "*=A"};
  EXPECT_EQ(error_of(overrides, two),
            "--light: \"lamp\" has no effect: \"*\" after it means all lights");
}

TEST(Overrides, LeaveOutWhatIsNotGiven) {
  v1::Scene scene = scene_from("settings { width: 7 spp: 3 method { rgb {} } }");
  const v1::Scene before = scene;
  ASSERT_TRUE(apply({}, scene));
  EXPECT_EQ(scene.DebugString(), before.DebugString());
}

TEST(Overrides, EachReplacesItsSetting) {
  v1::Scene scene = scene_from("settings { width: 7 spp: 3 observer: CIE_1931_2DEG }");
  Overrides overrides;
  overrides.size = "320x200";
  overrides.spp = 9;
  overrides.depth = 0;
  overrides.threads = 2;
  overrides.tile_size = 64;
  overrides.observer = "cie-1964-10deg";
  overrides.shading = "quadratic";
  overrides.method = "rgb";
  ASSERT_TRUE(apply(overrides, scene));
  EXPECT_EQ(scene.settings().width(), 320u);
  EXPECT_EQ(scene.settings().height(), 200u);
  EXPECT_EQ(scene.settings().spp(), 9u);
  EXPECT_TRUE(scene.settings().has_depth());
  EXPECT_EQ(scene.settings().depth(), 0u);
  EXPECT_EQ(scene.settings().threads(), 2u);
  EXPECT_EQ(scene.settings().tile_size(), 64u);
  EXPECT_EQ(scene.settings().observer(), v1::CIE_1964_10DEG);
  EXPECT_EQ(scene.settings().shading(), v1::QUADRATIC);
  EXPECT_TRUE(scene.settings().method().has_rgb());
}

TEST(Overrides, AnObserverTakesThePlaceOfAFileAndAFileThatOfAnObserver) {
  v1::Scene scene = scene_from("settings { observer_file: 'eye.csv' }");
  Overrides overrides;
  overrides.observer = "CIE_1964_10DEG";
  ASSERT_TRUE(apply(overrides, scene));
  EXPECT_EQ(scene.settings().observer(), v1::CIE_1964_10DEG);
  EXPECT_EQ(scene.settings().observer_file(), "");

  // A file lies where the words say, and not where the scene is.
  const std::string file = METAMER_TEST_DATA "/CMakeLists.txt";
  overrides.observer = file;
  const auto replaced = apply(overrides, scene);
  ASSERT_TRUE(replaced);
  EXPECT_EQ(scene.settings().observer(), v1::CIE_1931_2DEG);
  EXPECT_EQ(scene.settings().observer_file(), file);
  ASSERT_EQ(replaced->size(), 1u);
  EXPECT_EQ(replaced->front().field, "settings.observer_file");
  EXPECT_EQ(replaced->front().file, file);

  overrides.observer = "./nowhere.csv";
  EXPECT_EQ(error_of(overrides), "--observer: file \"./nowhere.csv\" does not exist");
}

TEST(Overrides, OfTheDevelopmentReplaceWhatTheSceneSays) {
  v1::Scene scene = scene_from(
      "settings { development { adaptation: SHARP primaries { red: 1 gamma: 2 } "
      "white_luminance: 3 } }");
  Overrides overrides;
  overrides.development.adaptation = "cmccat2000";
  overrides.development.rgb = "prophoto";
  overrides.development.linear = true;
  overrides.development.exposure = -1.5;
  const auto replaced = apply(overrides, scene);
  ASSERT_TRUE(replaced);
  EXPECT_EQ(scene.settings().development().adaptation(), v1::CMCCAT2000);
  EXPECT_EQ(scene.settings().development().rgb_space(), v1::PROPHOTO);
  EXPECT_FALSE(scene.settings().development().has_primaries());
  EXPECT_TRUE(scene.settings().development().linear());
  EXPECT_EQ(scene.settings().development().exposure(), -1.5);
  EXPECT_FALSE(scene.settings().development().has_white_luminance());

  overrides.development.rgb = "display-p4";
  EXPECT_EQ(error_of(overrides),
            "--rgb: no RGB space named \"display-p4\"; did you mean \"display-p3\"?");
  overrides.development.adaptation = "bradfort";
  EXPECT_EQ(error_of(overrides),
            "--adapt: no adaptation named \"bradfort\"; did you mean \"bradford\"?");
}

TEST(Overrides, PositionsAskForPointSamplingAndReplaceAllOthers) {
  v1::Scene scene = scene_from("settings { method { point { wavelengths: [400, 500] } } }");
  Overrides overrides;
  overrides.samples = "380:780:2.5";
  ASSERT_TRUE(apply(overrides, scene));
  const v1::Point& point = scene.settings().method().point();
  EXPECT_EQ(point.from(), 380);
  EXPECT_EQ(point.to(), 780);
  EXPECT_EQ(point.step(), 2.5);
  EXPECT_EQ(point.wavelengths_size(), 0);

  v1::Scene rgb = scene_from("settings { method { rgb {} } }");
  overrides = {};
  overrides.wavelengths = "400,436,546,700";
  ASSERT_TRUE(apply(overrides, rgb));
  ASSERT_EQ(rgb.settings().method().point().wavelengths_size(), 4);
  EXPECT_EQ(rgb.settings().method().point().wavelengths(1), 436);
}

TEST(Overrides, FittedAsksForPointSamplingAndReplacesAllPositions) {
  v1::Scene scene = scene_from("settings { method { point { wavelengths: [400, 500] } } }");
  Overrides overrides;
  overrides.fitted = 8;
  const auto replaced = apply(overrides, scene);
  ASSERT_TRUE(replaced);
  EXPECT_EQ(scene.settings().method().point().ShortDebugString(), "fitted: 8");
  EXPECT_EQ(replaced_by(*replaced, "settings.method.point.fitted"), "--fitted");
  overrides.samples = "400:700:5";
  EXPECT_EQ(error_of(overrides), "--fitted excludes --samples and --wavelengths");
}

TEST(Overrides, MethodPointKeepsTheScenesPositions) {
  v1::Scene scene = scene_from("settings { method { point { wavelengths: [400, 500] } } }");
  Overrides overrides;
  overrides.method = "point";
  ASSERT_TRUE(apply(overrides, scene));
  EXPECT_EQ(scene.settings().method().point().wavelengths_size(), 2);
}

TEST(Overrides, LightByNameOrAllOfThem) {
  const std::string text =
      "light { name: \"a=b\" spectrum { file: \"x\" entry: \"y\" } } light { name: \"c\" }";
  v1::Scene scene = scene_from(text);
  Overrides overrides;
  overrides.lights = {"a=b=F11"};
  ASSERT_TRUE(apply(overrides, scene));
  EXPECT_EQ(scene.light(0).spectrum().standard(), "F11");
  EXPECT_EQ(scene.light(0).spectrum().entry(), "");
  EXPECT_FALSE(scene.light(1).has_spectrum());

  scene = scene_from(text);
  overrides.lights = {"*=A", "c=D65"};
  ASSERT_TRUE(apply(overrides, scene));
  EXPECT_EQ(scene.light(0).spectrum().standard(), "A");
  EXPECT_EQ(scene.light(1).spectrum().standard(), "D65");
}

TEST(Overrides, AGoalAsksForTheMethodThatChooses) {
  const std::pair<const char*, double> times[] = {
      {"2", 2}, {"2s", 2}, {"500ms", 0.5}, {"1.5min", 90}};
  for (const auto& [text, seconds] : times) {
    v1::Scene scene;
    Overrides overrides;
    overrides.deadline = text;
    ASSERT_TRUE(apply(overrides, scene)) << text;
    EXPECT_DOUBLE_EQ(scene.settings().goal().deadline(), seconds) << text;
  }
  Overrides overrides;
  overrides.deadline = "2h";
  EXPECT_EQ(error_of(overrides), "--deadline: \"2h\" is not a time, such as 2s");
}

TEST(Overrides, MethodAutoIsAGoalAndKeepsTheScenes) {
  Overrides overrides;
  overrides.method = "auto";
  for (const auto& [before, after] :
       {std::pair{"method { rgb {} }", "goal { }"},
        {"goal { tolerance: 2 }", "goal { tolerance: 2 }"},
        {"method { auto { tolerance: 2 } }", "goal { tolerance: 2 }"}}) {
    v1::Scene scene = scene_from("settings { " + std::string(before) + " }");
    const auto replaced = apply(overrides, scene);
    ASSERT_TRUE(replaced);
    EXPECT_EQ(scene.settings().ShortDebugString(), after) << before;
    EXPECT_EQ(replaced_by(*replaced, "settings.goal"), "--method");
  }
  overrides.multi_pass = true;
  EXPECT_EQ(error_of(overrides), "--multi-pass is for --method point");
  overrides.method.reset();
  for (const char* text : {"settings { goal {} }", "settings { method { auto {} } }"})
    EXPECT_EQ(error_of(overrides, scene_from(text)), "--multi-pass is for --method point");
}

TEST(Overrides, ALightIsGivenOnce) {
  v1::Scene scene = scene_from("light { name: \"lamp\" }");
  Overrides overrides;
  overrides.lights = {"lamp=A", "lamp=D65"};
  const auto applied = apply(overrides, scene);
  ASSERT_FALSE(applied);
  EXPECT_EQ(applied.error().message, "--light: \"lamp\" is named twice");
}

TEST(Overrides, WhatTheyReplacedIsTheirs) {
  v1::Scene scene = scene_from("light { name: \"lamp\" } light { name: \"sun\" }");
  Overrides overrides;
  overrides.spp = 4;
  overrides.samples = "400:700:5";
  overrides.lights = {"sun=A"};
  const auto replaced = apply(overrides, scene);
  ASSERT_TRUE(replaced);
  EXPECT_EQ(replaced_by(*replaced, "settings.spp"), "--spp");
  EXPECT_EQ(replaced_by(*replaced, "settings.method.point.step"), "--samples");
  EXPECT_EQ(replaced_by(*replaced, "light[1].spectrum.standard"), "--light");
  EXPECT_EQ(replaced_by(*replaced, "light[0].spectrum.standard"), "");
  EXPECT_EQ(replaced_by(*replaced, "light[1].position"), "");
  EXPECT_EQ(replaced_by(*replaced, "settings.spp_of_another_kind"), "");
}

TEST(Overrides, ABackendAndItsPassesAreSettings) {
  v1::Scene scene;
  Overrides overrides;
  overrides.backend = "gl";
  overrides.multi_pass = true;
  overrides.samples = "400:700:10";
  ASSERT_TRUE(apply(overrides, scene));
  EXPECT_EQ(scene.settings().backend(), v1::GL);
  EXPECT_TRUE(scene.settings().method().point().multi_pass());
  EXPECT_EQ(scene.settings().method().point().step(), 10);

  overrides.samples.reset();
  overrides.method = "exact";
  EXPECT_EQ(error_of(overrides), "--multi-pass is for --method point");
  overrides.method.reset();
  overrides.tolerance = 1;
  EXPECT_EQ(error_of(overrides), "--tolerance is for --method auto");
  Overrides unknown;
  unknown.backend = "software";
  EXPECT_EQ(error_of(unknown), "--backend: no backend named \"software\"; there are cpu, gl");
}

TEST(Overrides, ErrorsSayWhatWasExpected) {
  Overrides both;
  both.samples = "400:700:5";
  both.wavelengths = "400,500";
  EXPECT_EQ(error_of(both), "--samples and --wavelengths exclude each other");

  Overrides rgb;
  rgb.method = "rgb";
  rgb.samples = "400:700:5";
  EXPECT_EQ(error_of(rgb), "--method rgb has no wavelengths to choose");

  Overrides method;
  method.method = "piont";
  EXPECT_EQ(error_of(method), "--method: no method named \"piont\"; did you mean \"point\"?");

  Overrides shading;
  shading.shading = "goraud";
  EXPECT_EQ(error_of(shading), "--shading: no shading named \"goraud\"; did you mean \"gouraud\"?");
  Overrides observer;
  observer.observer = "cie-1931";
  EXPECT_EQ(error_of(observer),
            "--observer: no observer named \"cie-1931\"; there are cie-1931-2deg, cie-1964-10deg; "
            "and there is no such file");

  for (const std::string bad : {"640", "640x", "x480", "640x480x3", "-1x5", "640x480 "}) {
    Overrides size;
    size.size = bad;
    EXPECT_EQ(error_of(size), "--size: \"" + bad + "\" is not WIDTHxHEIGHT, such as 640x480");
  }
  for (const std::string bad : {"400", "400:700", "400:700:5:1", "400:seven:5", "::"}) {
    Overrides samples;
    samples.samples = bad;
    EXPECT_EQ(error_of(samples),
              "--samples: \"" + bad + "\" is not FROM:TO:STEP, such as 400:700:5");
  }
  for (const std::string bad : {"", "400,", "400;500"}) {
    Overrides wavelengths;
    wavelengths.wavelengths = bad;
    EXPECT_EQ(error_of(wavelengths),
              "--wavelengths: \"" + bad + "\" is not a list of numbers, such as 400,436,546,700");
  }
  for (const std::string bad : {"lamp", "=A", "lamp="}) {
    Overrides lights;
    lights.lights = {bad};
    EXPECT_EQ(error_of(lights), "--light: \"" + bad + "\" is not NAME=SPECTRUM, such as ceiling=A");
  }
}

}  // namespace
}  // namespace metamer::cli
