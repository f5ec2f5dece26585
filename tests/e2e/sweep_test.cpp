// `metamer sweep`: each row is what `render` makes with its options, and is compared with one.
#include <gtest/gtest.h>

#include <filesystem>

#include "daemon.h"
#include "scenes.h"

namespace metamer::test {
namespace {

TEST(SweepCommand, MeasuresAllCombinationsAgainstOne) {
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const Ended ended = metamer({"sweep",       scene,
                               "--vary",      "method=rgb,exact",
                               "--vary",      "light=lamp=A,lamp=D65",
                               "--reference", "method=exact light=lamp=D65",
                               "-o",          folder / "out",
                               "--pictures",  folder / "%02d.exr",
                               "--sheet",     folder / "sheet.png",
                               "--size",      "24x16",
                               "--spp",       "1",
                               "--verify",    "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.err.find("light=lamp=D65: exact: ΔE00 against"), std::string::npos) << ended.err;
  const Json answer = parse_document(ended.out);
  ASSERT_EQ(answer["rows"].size(), 4u);
  for (const Json& row : answer["rows"]) {
    EXPECT_GT(row["cpu_seconds"], 0) << row;
    EXPECT_EQ(row["record"]["machine"].size(), 1u);
    EXPECT_EQ(row["accuracy"]["white"].size(), 3u);
  }
  EXPECT_EQ(answer["rows"][3]["values"]["light"], "lamp=D65");
  EXPECT_TRUE(answer["rows"][3]["reference"]);
  EXPECT_FALSE(answer["rows"][3].contains("error"));
  EXPECT_GT(answer["rows"][2]["error"]["maximum"], 1) << "another light";
  EXPECT_GT(answer["rows"][1]["error"]["maximum"], 0) << "another method";
  for (const char* file : {"out/sweep.csv", "out/sweep.json", "sheet.png", "01.exr", "04.exr"})
    EXPECT_TRUE(std::filesystem::exists(folder / file)) << file;

  const std::string rendered = folder / "rendered.exr";
  ASSERT_EQ(metamer({"render", scene, "--method", "exact", "--light", "lamp=A", "--size", "24x16",
                     "--spp", "1", "-o", rendered})
                .code,
            0);
  expect_same_pixels(read_exr(rendered), read_exr(folder / "03.exr"), "row 3");
}

TEST(SweepCommand, ARowThatCanNotBeHasItsReasonAndOthersGoOn) {
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const Ended ended = metamer({"sweep", scene, "--vary", "method=exact,rgb,linear", "--bases", "3",
                               "--size", "8x8", "--spp", "1", "--reference", "3", "--json"});
  EXPECT_EQ(ended.code, 4) << ended.err;
  const Json answer = parse_document(ended.out);
  EXPECT_EQ(answer["series"]["done"], 1);
  EXPECT_EQ(answer["rows"][0]["failure"], "--bases is for --method linear");
  EXPECT_FALSE(answer["rows"][2].contains("failure"));
}

/// A sweep whose first row is done, and whose second one nobody waits for, once `stop` has come.
void expect_rows_that_are_done(void (*stop)(Daemon&, Process&), int code, const char* why) {
  const Folder folder;
  Daemon server;
  const std::string scene = folder.write("scene.txtpb", endless_scene());
  const auto sweeping = server.start(
      {"sweep", scene, "--vary", "size=8x8,2048x2048", "-o", folder / "out", "--json"});
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  const auto is_done = [&] {
    const Json jobs = server.json({"jobs"})["jobs"];
    return jobs.size() == 2 && jobs[0]["state"] == "finished";
  };
  while (!is_done() && std::chrono::steady_clock::now() < end) {
  }
  stop(server, *sweeping);
  const Ended ended = sweeping->wait();
  EXPECT_EQ(ended.code, code) << ended.err;
  const Json answer = parse_document(ended.out);
  ASSERT_EQ(answer["rows"].size(), 2u);
  EXPECT_GT(answer["rows"][0]["timing"]["rays"], 0);
  EXPECT_EQ(answer["rows"][1]["failure"], why);
  EXPECT_TRUE(std::filesystem::exists(folder / "out/sweep.csv"));
}

TEST(SweepCommand, OneThatIsCancelledKeepsTheRowsThatAreDone) {
  expect_rows_that_are_done([](Daemon&, Process& sweeping) { sweeping.signal(SIGTERM); }, 5,
                            "cancelled");
}

TEST(SweepCommand, OneThatLosesItsDaemonKeepsTheRowsThatAreDone) {
  expect_rows_that_are_done([](Daemon& server, Process&) { server.signal(SIGKILL); }, 3,
                            "not finished");
}

TEST(SweepCommand, WhatCanNotBeIsSaidBeforeAnythingIsRendered) {
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const std::vector<std::pair<std::vector<std::string>, std::string>> wrong = {
      {{"--vary", "methd=rgb"}, "did you mean \"method\"?"},
      {{"--vary", "spp=1,2", "--vary", "spp=4"}, "is varied twice"},
      {{"--vary", "spp=1,2", "--reference", "3"}, "there is no row 3 of 2"},
      {{"--vary", "spp=0,1"}, "the reference, row 1 (spp=0), can't be rendered"},
      {{"--vary", "spp=1,4", "--spp", "9"}, "\"spp\" is varied and given"},
      {{"--vary", "spp=1,2", "--pictures", folder / "s%d.png", "--sheet", folder / "s2.png"},
       "s2.png\" is named twice"},
      {{"--vary", "spp=1", "--pictures", folder / "a.exr"}, "--pictures: "}};
  for (const auto& [words, message] : wrong) {
    std::vector<std::string> all = {"sweep", scene};
    all.insert(all.end(), words.begin(), words.end());
    expect_refused(all, message);
  }
}

}  // namespace
}  // namespace metamer::test
