// `metamer turntable`: its frames are what `render` makes of the scene seen from there.
#include <gtest/gtest.h>

#include <filesystem>

#include "daemon.h"
#include "scenes.h"

namespace metamer::test {
namespace {

/// The scene with its eye, at (0, 1.2, 4), where a quarter of a turn about y takes it.
std::string seen_from_the_right(std::string scene) {
  const std::string eye = "eye { y: 1.2 z: 4 }";
  scene.replace(scene.find(eye), eye.size(), "eye { x: 4 y: 1.2 }");
  return scene;
}

class TurntableCommand : public testing::Test {
 protected:
  Folder folder_;
  std::string scene_ = folder_.write("scene.txtpb", small_scene());
  std::vector<std::string> quick_ = {"--size", "24x16", "--spp", "1"};

  std::vector<std::string> with_quick(std::vector<std::string> words) const {
    words.insert(words.end(), quick_.begin(), quick_.end());
    return words;
  }
};

TEST_F(TurntableCommand, FramesAreTheSceneFromAllAround) {
  const std::string other = folder_.write("other.txtpb", seen_from_the_right(small_scene()));
  const Ended ended = metamer(with_quick({"turntable", scene_, "--frames", "0:4:2", "--count", "8",
                                          "-o", folder_ / "f-%03d.exr", "-o", folder_ / "%d.png",
                                          "--sheet", folder_ / "sheet.png", "--json"}));
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json answer = parse_document(ended.out);
  EXPECT_EQ(answer["series"]["done"], 3);
  EXPECT_EQ(answer["series"]["failed"], 0);
  EXPECT_EQ(answer["frames"].size(), 3u);
  EXPECT_EQ(answer["files"].size(), 7u);
  EXPECT_NE(answer["movie"].get<std::string>().find("$(seq 0 2 4)"), std::string::npos);
  for (const char* file : {"f-000.exr", "f-002.exr", "f-004.exr", "0.png", "2.png", "4.png"})
    EXPECT_TRUE(std::filesystem::exists(folder_ / file)) << file;

  for (const auto& [scene, frame] : {std::pair{scene_, "f-000.exr"}, {other, "f-002.exr"}}) {
    const std::string rendered = folder_ / "rendered.exr";
    ASSERT_EQ(metamer(with_quick({"render", scene, "-o", rendered})).code, 0);
    const Image expected = read_exr(rendered), turned = read_exr(folder_ / frame);
    expect_a_picture(turned);
    if (scene == scene_) {
      expect_same_pixels(expected, turned, frame);
      continue;
    }
    // sin and cos of a quarter are off by an ulp, which moves an edge by less than one can see.
    double sum = 0, difference = 0;
    for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
      sum += std::abs(static_cast<double>(expected.pixels[i]));
      difference += std::abs(static_cast<double>(expected.pixels[i] - turned.pixels[i]));
    }
    EXPECT_LT(difference, 1e-3 * sum);
  }
  const Result<Image> sheet = read_image(folder_ / "sheet.png");
  ASSERT_TRUE(sheet);
  EXPECT_GT(sheet->width, 2 * 24 * 15) << "two pictures wide, each enlarged by 15";
}

TEST_F(TurntableCommand, ASeriesIsOneLineAndOneWordToItsServer) {
  const Daemon server;
  const std::string endless = folder_.write("endless.txtpb", endless_scene());
  const auto turning =
      server.start({"turntable", endless, "--frames", "0:99", "-o", folder_ / "%04d.png"});
  // Until it has submitted as many as it does at a time.
  Json answer;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  do {
    answer = server.json({"jobs"});
  } while (answer["jobs"].size() < 16 && std::chrono::steady_clock::now() < end);
  ASSERT_EQ(answer["jobs"].size(), 16u);
  ASSERT_EQ(answer["series"].size(), 1u);
  EXPECT_EQ(answer["series"][0]["count"], 100);
  EXPECT_EQ(answer["series"][0]["name"], "endless.txtpb, turntable");
  const std::string handle = answer["series"][0]["handle"];
  const std::string closed = server.metamer({"jobs"}).out;
  EXPECT_EQ(std::count(closed.begin(), closed.end(), '\n'), 1) << closed;
  const std::string opened = server.metamer({"jobs", "--series", handle}).out;
  EXPECT_EQ(std::count(opened.begin(), opened.end(), '\n'), 16) << opened;
  EXPECT_NE(opened.find("endless.txtpb, frame 15"), std::string::npos) << opened;

  EXPECT_EQ(server.json({"priority", handle, "7"})["jobs"].size(), 16u);
  const Json paused = server.json({"pause", "series:endless.txtpb, turntable"});
  EXPECT_EQ(paused["jobs"].size(), 16u);
  for (const Json& job : paused["jobs"]) EXPECT_EQ(job["priority"], 7);
  EXPECT_EQ(server.json({"resume", handle})["jobs"].size(), 16u);
  // Whoever made the series has no more of it either, and cancels some of its jobs first.
  EXPECT_EQ(server.json({"cancel", handle})["exit_code"], 0);
  const Ended ended = turning->wait();
  EXPECT_EQ(ended.code, 5) << ended.err;
  for (const Json& job : server.json({"jobs"})["jobs"]) EXPECT_EQ(job["state"], "cancelled");
  EXPECT_EQ(server.metamer({"cancel", handle}).code, 2) << "all have ended";
  EXPECT_EQ(server.metamer({"watch", handle}).code, 2);
}

TEST_F(TurntableCommand, CtrlCCancelsAllThatWasSubmitted) {
  const Daemon server;
  const std::string endless = folder_.write("endless.txtpb", endless_scene());
  const auto turning =
      server.start({"turntable", endless, "--frames", "0:99", "-o", folder_ / "%04d.png"});
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (server.json({"jobs"})["jobs"].size() < 2 && std::chrono::steady_clock::now() < end) {
  }
  turning->signal(SIGINT);
  const Ended ended = turning->wait();
  EXPECT_EQ(ended.code, 5) << ended.err;
  for (const Json& job : server.json({"jobs"})["jobs"]) EXPECT_EQ(job["state"], "cancelled");
}

TEST_F(TurntableCommand, WhatCanNotBeIsSaidBeforeAnythingIsRendered) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--frames", "0:3", "-o", folder_ / "a.png"}, "no place for the frame's number"},
      {{"--frames", "0:3", "-o", folder_ / "a-%04d.jpg"}, "neither in .png nor in .exr"},
      {{"--frames", "0:3", "-o", folder_ / "none/%d.png"}, "there is no folder"},
      {{"--frames", "3:0", "-o", folder_ / "%d.png"}, "ends before it begins"},
      {{"--frames", "0:3", "-o", folder_ / "%d.png", "--sheet", folder_ / "s.exr"}, "is no .png"},
      {{"--frames", "0:1", "-o", folder_ / "a%d.png", "--sheet", folder_ / "./a1.png"},
       "a1.png\" is named twice"},
      {{"--frames", "0:10", "-o", folder_ / "%d.png", "-o", folder_ / "%02d.png"},
       "10.png\" is named twice"}};
  for (const auto& [words, message] : wrong) {
    std::vector<std::string> all = {"turntable", scene_};
    all.insert(all.end(), words.begin(), words.end());
    expect_refused(all, message);
  }
}

}  // namespace
}  // namespace metamer::test
