// --json: one document on stdout for every subcommand, whatever happens.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "daemon.h"
#include "scenes.h"

namespace metamer::test {
namespace {

class JsonOutput : public testing::Test {
 protected:
  Daemon daemon;
  Folder folder;
  std::string scene = folder.write("scene.txtpb", small_scene());
};

TEST_F(JsonOutput, Render) {
  const std::string file = folder / "a.png";
  const Json answer = daemon.json({"render", scene, "-o", file});
  EXPECT_EQ(answer["exit_code"], 0);
  EXPECT_EQ(answer["job_id"], 1);
  EXPECT_EQ(answer["state"], "finished");
  EXPECT_EQ(answer["files"], Json::array({file}));
  EXPECT_EQ(answer["plan"]["width"], 75);
  EXPECT_EQ(answer["plan"]["observer"], "cie-1931-2deg");
  EXPECT_EQ(answer["plan"]["bands"], 3);
  EXPECT_GT(answer["timing"]["rays"].get<std::uint64_t>(), 75u * 53 * 4);
}

TEST_F(JsonOutput, OfProblemsHoldsTheirPlaces) {
  std::string text = small_scene();
  text.replace(text.find("spp: 4"), 6, "spp: 5000");
  const std::string bad = folder.write("bad.txtpb", text);
  const Json answer = daemon.json({"render", bad, "-o", folder / "a.png"});
  EXPECT_EQ(answer["exit_code"], 2);
  ASSERT_EQ(answer["problems"].size(), 1u) << answer;
  EXPECT_EQ(answer["problems"][0]["field"], "settings.spp");
  EXPECT_EQ(answer["problems"][0]["file"], bad);
  EXPECT_GT(answer["problems"][0]["line"].get<int>(), 0);
}

TEST_F(JsonOutput, JobsSubmitAndControl) {
  EXPECT_EQ(daemon.json({"jobs"})["jobs"], Json::array());
  const Json submitted = daemon.json({"submit", scene});
  EXPECT_EQ(submitted["job_id"], 1);
  EXPECT_EQ(daemon.metamer({"watch", "1"}).code, 0);
  const Json jobs = daemon.json({"jobs"});
  ASSERT_EQ(jobs["jobs"].size(), 1u);
  EXPECT_EQ(jobs["jobs"][0]["name"], "scene.txtpb");
  EXPECT_EQ(jobs["jobs"][0]["state"], "finished");
  const Json refused = daemon.json({"pause", "1"});
  EXPECT_EQ(refused["exit_code"], 2);
  EXPECT_EQ(refused["errors"].size(), 1u);
  const Json fetched = daemon.json({"fetch", "1", "-o", folder / "f.png"});
  EXPECT_EQ(fetched["state"], "finished");
}

TEST_F(JsonOutput, WatchIsALineAnEvent) {
  const std::string job = daemon.submit(scene);
  const Ended ended = daemon.metamer({"watch", job, "--json"});
  EXPECT_EQ(ended.code, 0);
  std::uint64_t last = 0;
  std::size_t begin = 0;
  for (std::size_t end; (end = ended.out.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const Json event = parse_document(ended.out.substr(begin, end - begin));
    EXPECT_GT(event["sequence"].get<std::uint64_t>(), last);
    last = event["sequence"];
    EXPECT_EQ(event["job_id"], 1);
    EXPECT_FALSE(event.contains("tile"));
  }
  EXPECT_EQ(begin, ended.out.size());
  EXPECT_NE(ended.out.find("\"planned\""), std::string::npos);
  EXPECT_NE(ended.out.find("\"finished\""), std::string::npos);
}

TEST_F(JsonOutput, InfoNamesModelsAndWorkers) {
  const Json info = daemon.json({"info"});
  EXPECT_GT(info["ping_seconds"].get<double>(), 0);
  EXPECT_EQ(info["info"]["worker"].size(), 3u);  // the CPU's, the GL's, the CPU's of views
  EXPECT_EQ(info["info"]["capabilities"]["method"],
            Json::array({"point", "rgb", "exact", "linear", "prefilter", "auto"}));
  EXPECT_EQ(info["info"]["capabilities"]["model"][0]["name"], "lambert");
}

TEST_F(JsonOutput, InfoIsAScreenAndTellsAllOnRequest) {
  const Json capabilities = daemon.json({"info"})["info"]["capabilities"];
  const std::string screen = daemon.metamer({"info"}).out;
  EXPECT_LE(std::count(screen.begin(), screen.end(), '\n'), 24) << screen;
  std::istringstream lines(screen);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  const std::string all = daemon.metamer({"info", "--all"}).out;
  const std::string models = daemon.metamer({"info", "--models"}).out;
  const std::string methods = daemon.metamer({"info", "--methods"}).out;
  for (const Json& model : capabilities["model"]) {
    EXPECT_NE(screen.find(model["name"].get<std::string>()), std::string::npos) << model;
    for (const std::string* text : {&all, &models})
      EXPECT_NE(text->find(model["citation"].get<std::string>()), std::string::npos) << model;
  }
  for (const Json& set : capabilities["method_features"])
    for (const std::string* text : {&all, &methods})
      EXPECT_NE(text->find("method " + set["name"].get<std::string>() + ": "), std::string::npos);
  EXPECT_EQ(methods.find("worker"), std::string::npos);
}

TEST_F(JsonOutput, CheckGivesThePlanAndRendersNothing) {
  const Json answer = daemon.json({"check", scene, "--size", "32x16"});
  EXPECT_EQ(answer["exit_code"], 0) << answer;
  EXPECT_EQ(answer["plan"]["width"], 32);
  EXPECT_EQ(answer["plan"]["height"], 16);
  const Ended text = daemon.metamer({"check", scene});
  EXPECT_EQ(text.out.rfind("good: 75x53, 4 samples per pixel, ", 0), 0u) << text.out;
}

}  // namespace
}  // namespace metamer::test
