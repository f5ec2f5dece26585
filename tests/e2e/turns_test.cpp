// Jobs have turns with each other; what a turn costs is time, and nothing of the picture.
#include <gtest/gtest.h>

#include "running_job.h"

namespace metamer::test {
namespace {

std::size_t count_of(const std::string& word, const std::string& text) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != text.npos; at += word.size()) ++count;
  return count;
}

TEST(Turns, AJobThatYieldsOverAndOverIsTheSamePicture) {
  const Daemon daemon(Daemon::Listens::unix_socket, {"--turn", "0.05", "--worker-timeout", "60"});
  const Folder folder;
  const std::string small = folder.write("small.txtpb", small_scene());
  RunningJob job(daemon);
  for (int i = 0; i < 3; ++i) {
    HeldWorkers held(daemon);  // lest either job should end before the other is urgent
    const std::string urgent = daemon.submit(small);
    EXPECT_EQ(daemon.metamer({"priority", urgent, "5"}).code, 0);
    held.release();
    EXPECT_EQ(daemon.metamer({"watch", urgent}).code, 0);
  }
  const RunningJob::End end = job.end();
  EXPECT_EQ(end.code, 0);
  EXPECT_GE(count_of("others have their turn", end.events), 1u);
  EXPECT_EQ(count_of("\"retrying\"", end.events), 0u);
  const Json& machines = end.last["finished"]["record"]["machine"];
  ASSERT_EQ(machines.size(), 1u) << machines;
  EXPECT_EQ(machines[0]["tiles"], 80 * 60) << "of all turns together";
  const std::string interrupted = folder / "interrupted.exr";
  const std::string whole = folder / "whole.exr";
  ASSERT_EQ(daemon.metamer({"fetch", job.id(), "-o", interrupted, "--exr", "xyz"}).code, 0);
  const std::string scene = folder.write("long.txtpb", long_scene());
  ASSERT_EQ(daemon.metamer({"render", scene, "-o", whole, "--exr", "xyz"}).code, 0);
  expect_same_pixels(read_exr(whole), read_exr(interrupted), "in turns and at once");
}

TEST(Turns, WhatAJobWaitsForIsSaid) {
  const Daemon daemon;
  const Folder folder;
  const std::string small = folder.write("small.txtpb", small_scene());
  RunningJob job(daemon, endless_scene());
  const std::string second = daemon.submit(small);
  const std::string third = daemon.submit(small);
  const std::string text = daemon.metamer({"jobs", "--why", "--mine"}).out;
  EXPECT_NE(text.find("waits: 1 job of the same user comes before it"), text.npos) << text;
  EXPECT_NE(text.find("waits: 2 jobs of the same user come before it"), text.npos) << text;
  EXPECT_EQ(daemon.metamer({"priority", third, "-7"}).code, 0);
  const Json jobs = daemon.json({"jobs"})["jobs"];
  ASSERT_EQ(jobs.size(), 3u);
  EXPECT_EQ(jobs[2]["priority"], -7);
  EXPECT_EQ(jobs[2]["reason"], "2 jobs of the same user come before it");
  EXPECT_GT(jobs[0]["worker_seconds"], 0);
  EXPECT_EQ(daemon.metamer({"priority", third, "101"}).code, 2);
  EXPECT_EQ(daemon.metamer({"priority", third, "0.5"}).code, 2);

  const Json both = daemon.json({"cancel", second, third});
  EXPECT_EQ(both["jobs"].size(), 2u) << both;
  daemon.submit(small);
  const Json all = daemon.json({"cancel", "--all"});
  EXPECT_EQ(all["jobs"].size(), 2u) << all;
  for (const Json& one : daemon.json({"jobs"})["jobs"]) EXPECT_EQ(one["state"], "cancelled");
  EXPECT_EQ(daemon.json({"cancel", "--all"})["jobs"], Json::array());
  EXPECT_EQ(daemon.metamer({"cancel"}).code, 2);
  EXPECT_EQ(daemon.metamer({"cancel", second, "--all"}).code, 2);
}

}  // namespace
}  // namespace metamer::test
