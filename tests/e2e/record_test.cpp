// The record that comes with a finished job: what ran it, and what it did.
#include <gtest/gtest.h>

#include "daemon.h"
#include "running_job.h"
#include "scenes.h"

namespace metamer::test {
namespace {

std::uint64_t tiles_of(const Json& record) {
  std::uint64_t sum = 0;
  for (const Json& machine : record["machine"]) sum += machine["tiles"].get<std::uint64_t>();
  return sum;
}

/// A thread may use no more than the clock's time; the two clocks are not read at one instant.
void expect_sound(const Json& record, unsigned threads) {
  EXPECT_FALSE(record["build"].get<std::string>().empty());
  EXPECT_FALSE(record["server_build"].get<std::string>().empty());
  ASSERT_FALSE(record["phase"].empty());
  // The worker's process has a few more threads, which hardly do anything.
  constexpr double grain = 0.05;
  for (const Json& phase : record["phase"]) {
    EXPECT_GT(phase["cpu_seconds"], 0) << phase;
    EXPECT_LE(phase["cpu_seconds"].get<double>(), threads * phase["seconds"].get<double>() + grain)
        << phase;
  }
}

TEST(Record, SaysWhatRanAJobAndWhatItDid) {
  const Folder folder;
  const std::string scene = folder.write("scene.txtpb", small_scene());
  const Ended ended = metamer({"render", scene, "-o", folder / "a.exr", "--tile-size", "16",
                               "--threads", "1", "--verify", "--json"});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json answer = parse_document(ended.out);
  const Json& record = answer["record"];
  expect_sound(record, 1);
  ASSERT_EQ(record["machine"].size(), 1u);
  EXPECT_FALSE(record["machine"][0]["name"].get<std::string>().empty());
  EXPECT_EQ(record["machine"][0]["threads"], 1);
  EXPECT_EQ(tiles_of(record), 5u * 4) << "75 by 53 pixels by 16";
  std::vector<std::string> phases;
  for (const Json& phase : record["phase"]) phases.push_back(phase["name"]);
  EXPECT_EQ(phases, (std::vector<std::string>{"compile", "acceleration", "pilot", "prepare",
                                              "render", "verify"}));
  EXPECT_TRUE(record["warm"].empty());
}

TEST(Record, OfAJobThatWasPausedIsThatOfBothItsAttempts) {
  const Daemon server;
  std::string scene = long_scene();
  scene.replace(scene.find("spp: 32"), 7, "spp: 8");
  const RunningJob job(server, scene);
  ASSERT_EQ(server.metamer({"pause", job.id()}).code, 0);
  ASSERT_EQ(server.metamer({"jobs", "--record", job.id()}).code, 2) << "it has not finished";
  ASSERT_EQ(server.metamer({"resume", job.id()}).code, 0);
  ASSERT_EQ(server.metamer({"watch", job.id()}).code, 0);
  const Json answer = server.json({"jobs", "--record", job.id()});
  const Json& record = answer["record"];
  expect_sound(record, 1);
  ASSERT_EQ(record["machine"].size(), 1u) << record;
  EXPECT_EQ(tiles_of(record), 80u * 60);
  // The clock of the whole: all that both attempts did.
  double seconds = 0;
  for (const Json& phase : record["phase"]) seconds += phase["seconds"].get<double>();
  EXPECT_LE(seconds, answer["timing"]["total"].get<double>() + 0.5);
  const std::string text = server.metamer({"jobs", "--record", job.id()}).out;
  EXPECT_NE(text.find("4800 tiles\n"), std::string::npos) << text;
  EXPECT_NE(text.find("phase    render"), std::string::npos) << text;
}

}  // namespace
}  // namespace metamer::test
