#include <gtest/gtest.h>

#include "common/scene/scene_file.h"
#include "scene_text.h"

namespace metamer::test {
namespace {

constexpr const char* scene =
    "# a scene\n"
    "camera { eye { z: 4 } }\n"
    "light { name: \"a\" }\n"
    "light {\n"
    "\tname: \"b\"\n"
    "\tspectrum { samples { wavelength: [400, 500,  600] value: 1 value: 2 value: [3] } }\n"
    "}\n"
    "object { transform { translate { x: 1 } } transform { scale { } } }\n";

TEST(SceneLocate, RepeatedFieldsGoByTheirIndex) {
  EXPECT_EQ(place_of(scene, "light[0]"), "3:1");
  EXPECT_EQ(place_of(scene, "light[1]"), "4:1");
  EXPECT_EQ(place_of(scene, "light[0].name"), "3:9");
  EXPECT_EQ(place_of(scene, "light[1].name"), "5:2");
}

TEST(SceneLocate, NestedMessagesAreFollowed) {
  EXPECT_EQ(place_of(scene, "camera.eye.z"), "2:16");
  EXPECT_EQ(place_of(scene, "object[0].transform[1].scale"), "8:55");
}

TEST(SceneLocate, ElementsOfListsHaveTheirOwnPlace) {
  EXPECT_EQ(place_of(scene, "light[1].spectrum.samples.wavelength[0]"), "6:36");
  EXPECT_EQ(place_of(scene, "light[1].spectrum.samples.wavelength[1]"), "6:41");
  EXPECT_EQ(place_of(scene, "light[1].spectrum.samples.wavelength[2]"), "6:47");
  EXPECT_EQ(place_of(scene, "light[1].spectrum.samples.value[1]"), "6:61");
  EXPECT_EQ(place_of(scene, "light[1].spectrum.samples.value[2]"), "6:78");
}

TEST(SceneLocate, ListsOfMessagesAreFollowed) {
  constexpr const char* text =
      "light: [{ name: \"a\" }, { name: \"b\" spectrum { constant: -1 } }]";
  EXPECT_EQ(place_of(text, "light[1]"), "1:24");
  EXPECT_EQ(place_of(text, "light[1].spectrum.constant"), "1:47");
}

TEST(SceneLocate, MissingFieldsStandAtTheNearestParentThatIsThere) {
  EXPECT_EQ(place_of(scene, "light[0].spectrum.file"), "3:1");
  EXPECT_EQ(place_of(scene, "object[0].transform[1].scale.x"), "8:55");
  EXPECT_EQ(place_of(scene, "camera.up"), "2:1");
  EXPECT_EQ(place_of(scene, "light[7].name"), "nowhere");
  EXPECT_EQ(place_of(scene, "settings.width"), "nowhere");
}

TEST(SceneLocate, ARepeatedFieldWithoutIndexStandsAtItsFirst) {
  EXPECT_EQ(place_of(scene, "light"), "3:1");
  EXPECT_EQ(place_of(scene, "light[1].spectrum.samples.value"), "6:52");
}

TEST(SceneLocate, PathsThatAreNoneAreNowhere) {
  for (const char* path : {"", ".", "[", "light[", "light[]", "light[x]", "light[-1]", "lamp",
                           "camera[0]", "light[99999999999999999999]", "light[0"}) {
    EXPECT_EQ(place_of(scene, path), "nowhere") << path;
  }
  EXPECT_EQ(place_of(scene, "camera.eye.z.more"), "2:16");
  EXPECT_EQ(place_of(scene, "camera..eye"), "2:1");
}

TEST(SceneLocate, ANumberIsNamedAsItIsWritten) {
  const auto was = [](const std::string& text, const std::string& field, const std::string& value) {
    const auto file = SceneFile::parse(text, "s.txtpb");
    EXPECT_TRUE(file) << text;
    Problem problem{.field = field, .file = {}, .message = {}, .was = value, .meant = "1"};
    return file->locate(problem).was;
  };
  EXPECT_EQ(was("camera { eye { z: 2.0E+15 } }", "camera.eye.z", "2e+15"), "2.0E+15");
  EXPECT_EQ(was("camera { eye { z :\n\t-0.50 } }", "camera.eye.z", "-0.5"), "-0.50");
  EXPECT_EQ(was("settings { width: 020 }", "settings.width", "16"), "16") << "octal: left as it is";
  EXPECT_EQ(was("camera { eye { z: 1 } }", "camera.eye.y", "0"), "0") << "not in the text";
  EXPECT_EQ(was("object { material: '7' }", "object[0].material", "7"), "7");
  const std::string list = "light { spectrum { samples { wavelength: [4e2, 500.0] } } }";
  EXPECT_EQ(was(list, "light[0].spectrum.samples.wavelength[0]", "400"), "4e2");
  EXPECT_EQ(was(list, "light[0].spectrum.samples.wavelength[1]", "500"), "500.0");
}

TEST(SceneLocate, APlaceInsideAnAssetStays) {
  const auto file = SceneFile::parse(scene, "s.txtpb");
  ASSERT_TRUE(file);
  const Problem problem = file->locate(
      {.field = "camera", .file = "a.sp", .line = 7, .column = 3, .message = "bad number"});
  EXPECT_EQ(format(problem), "a.sp:7:3: error: bad number");
}

TEST(SceneLocate, OverridesDoNotMoveAnything) {
  auto file = SceneFile::parse(scene, "s.txtpb");
  ASSERT_TRUE(file);
  file->scene().add_light();
  file->scene().mutable_settings()->set_width(0);
  EXPECT_EQ(file->locate({.field = "light[2]", .file = {}, .message = {}}).line, 0);
  const Problem width = file->locate({.field = "settings.width", .file = {}, .message = "bad"});
  EXPECT_EQ(format(width), "s.txtpb: error: settings.width: bad");
}

}  // namespace
}  // namespace metamer::test
