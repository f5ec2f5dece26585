// A scene is read, changed and checked; all that is wrong with it comes as located values.
#include "client/tools/scene/checked_scene.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace metamer::client {
namespace {

namespace fs = std::filesystem;

const char* const sound = R"(camera { eye { z: 4 } target {} }
light { name: "lamp" position { z: 4 } spectrum { standard: "D65" } }
material { name: "m" diffuse { file: "red.txt" } diffuseness: 1 }
object { name: "o" material: "m" sphere { radius: 1 } }
)";

class Scenes : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directory(folder);
    write("red.txt", "400 0.1\n700 0.9\n");
  }
  void TearDown() override { fs::remove_all(folder); }

  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder / name, std::ios::binary | std::ios::trunc) << text;
  }

  CheckedScene parse(const std::string& text, const CheckedScene::Change& change = {}) {
    return CheckedScene::parse(text, folder / "scene.txtpb", digests, change);
  }

  static std::string replaced(std::string text, const std::string& a, const std::string& b) {
    return text.replace(text.find(a), a.size(), b);
  }

  fs::path folder = fs::temp_directory_path() / ("metamer-checked-" + std::to_string(getpid()));
  DigestCache digests{100, [] { return DigestCache::system_now() + std::chrono::hours(1); }};
};

TEST_F(Scenes, ASoundOneIsReadyToBeSent) {
  const CheckedScene scene = parse(sound);
  EXPECT_TRUE(scene.sound());
  EXPECT_EQ(scene.name(), "scene.txtpb");
  EXPECT_EQ(scene.scene().object(0).name(), "o");
  ASSERT_EQ(scene.assets().size(), 1u);
  EXPECT_EQ(scene.assets()[0].sha256, sha256("400 0.1\n700 0.9\n"));

  write("scene.txtpb", sound);
  EXPECT_TRUE(CheckedScene::read(folder / "scene.txtpb", digests).sound());
  EXPECT_EQ(digests.files_read(), 1u);
}

TEST_F(Scenes, ATextThatCannotBeParsedHasOneProblemAndNoScene) {
  const CheckedScene scene = parse(replaced(sound, "radius", "radios"));
  ASSERT_EQ(scene.problems().size(), 1u);
  EXPECT_EQ(scene.problems()[0].line, 4);
  EXPECT_EQ(scene.scene().object_size(), 0);
  EXPECT_NE(scene.describe(scene.problems()[0]).find("sphere { radios: 1 }"), std::string::npos);
}

TEST_F(Scenes, AFileThatIsNotThereIsAProblem) {
  const CheckedScene scene = CheckedScene::read(folder / "gone.txtpb", digests);
  ASSERT_EQ(scene.problems().size(), 1u);
  EXPECT_EQ(scene.problems()[0].message, "file does not exist");
  EXPECT_EQ(scene.problems()[0].file, (folder / "gone.txtpb").string());
}

TEST_F(Scenes, AllProblemsAreThereEachAtItsPlace) {
  const CheckedScene scene =
      parse(replaced(replaced(replaced(sound, "radius: 1", "radius: -1"), "red.txt", "rad.txt"),
                     "material: \"m\"", "material: \"n\""));
  ASSERT_EQ(scene.problems().size(), 3u);
  for (const Problem& one : scene.problems()) {
    EXPECT_EQ(one.file, (folder / "scene.txtpb").string());
    EXPECT_GE(one.line, 3);
    EXPECT_GT(one.column, 1);
  }
  EXPECT_TRUE(scene.assets().empty());
  EXPECT_EQ(scene.scene().object(0).material(), "n");
}

TEST_F(Scenes, AFaultInsideAFileIsShownThere) {
  write("red.txt", "400 0.1\n500 x\n");
  const CheckedScene scene = parse(sound);
  ASSERT_EQ(scene.problems().size(), 1u);
  EXPECT_EQ(scene.problems()[0].file, (folder / "red.txt").string());
  EXPECT_EQ(scene.problems()[0].line, 2);
  EXPECT_NE(scene.describe(scene.problems()[0]).find("500 x"), std::string::npos);
}

TEST_F(Scenes, WhatAChangeBrokeIsTheChangesOnce) {
  const CheckedScene scene = parse(sound, [](v1::Scene& changed) {
    changed.mutable_settings()->set_width(0);
    changed.mutable_settings()->set_height(0);
    return std::vector<Replaced>{{"settings.width", "size"}, {"settings.height", "size"}};
  });
  ASSERT_FALSE(scene.sound());
  for (const Problem& one : scene.problems()) {
    EXPECT_EQ(one.message.substr(0, 6), "size: ");
    EXPECT_EQ(one.line, 0);
  }
  const Problem same{.field = "settings.width", .file = {}, .message = "it is too small"};
  EXPECT_EQ(scene.locate(std::vector<Problem>{same, same}).size(), 1u);
}

TEST_F(Scenes, AChangeThatFailsIsTheOnlyProblem) {
  const CheckedScene scene = parse(replaced(sound, "radius: 1", "radius: -1"), [](v1::Scene&) {
    return Result<std::vector<Replaced>>(problem("no such light"));
  });
  ASSERT_EQ(scene.problems().size(), 1u);
  EXPECT_EQ(scene.problems()[0].message, "no such light");
}

TEST_F(Scenes, ProblemsOfAServerFindTheirPlaces) {
  const CheckedScene scene = parse(sound);
  const Problem in_field =
      scene.locate({.field = "object[0].sphere.radius", .file = {}, .message = "too small"});
  EXPECT_EQ(in_field.line, 4);
  const Problem in_file =
      scene.locate({.field = {}, .file = "red.txt", .line = 2, .column = 1, .message = "odd"});
  EXPECT_EQ(in_file.file, (folder / "red.txt").string());
  const Problem of_file =
      scene.locate({.field = "material[0].diffuse.file", .file = "red.txt", .message = "is odd"});
  EXPECT_EQ(of_file.message, "\"red.txt\" is odd");
  EXPECT_EQ(of_file.line, 3);
}

}  // namespace
}  // namespace metamer::client
