// What people and programs read: progress, JSON.
#include <gtest/gtest.h>

#include "client/cli/json.h"
#include "client/cli/progress.h"
#include "client/cli/report.h"
#include "client/tools/text/job_text.h"

namespace metamer::cli {
namespace {

v1::Progress progress_of(std::uint32_t done, std::uint32_t tiles, std::uint64_t rays,
                         double seconds, double left) {
  v1::Progress progress;
  progress.set_tiles_done(done);
  progress.set_tiles(tiles);
  progress.set_rays(rays);
  progress.set_seconds(seconds);
  progress.set_seconds_left(left);
  return progress;
}

TEST(Terminal, IsNotCommandedByWhatAServerSays) {
  v1::JobSummary job;
  job.set_job_id(1);
  job.set_name("a\n               2  finished\x1b[2J");
  job.set_reason(
      "b\r\xC2\x9B"
      "1A");
  job.set_state(v1::FAILED);
  job.set_user("\x1b[31mu");
  const std::string line = client::describe(job, "");
  EXPECT_EQ(line.find('\x1b'), std::string::npos);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  Report report(false);
  report.line(line);
  report.line("its own\n\tlines \x1b]0;title\x07");
  report.error("c\x1b[2J");
  report.note({.field = {}, .file = "d\x1b", .line = 1, .message = "e\xE2\x80\xAE"});
  const std::string out = testing::internal::GetCapturedStdout();
  const std::string err = testing::internal::GetCapturedStderr();
  EXPECT_EQ(out.substr(out.find("a?")),
            "a?               2  finished?[2J  (b??1A)\nits own\n\tlines ?]0;title?\n");
  EXPECT_EQ(err, "error: c?[2J\nd?:1: note: e?\n");
}

TEST(Bar, ShowsShareRateAndTimeLeft) {
  EXPECT_EQ(bar(progress_of(40, 100, 24'600'000, 2, 7), 50),
            "[######---------]   40 %  12.3 Mrays/s  0:07 left");
  EXPECT_EQ(bar(progress_of(100, 100, 1, 1, 0), 200),
            "[########################################]  100 %  0.0 Mrays/s  0:00 left");
}

TEST(Bar, NeverFillsTheLastColumn) {
  // There the terminal would begin a new line.
  for (int columns = 0; columns < 120; ++columns)
    EXPECT_LT(bar(progress_of(1, 3, 1'000'000, 1, 2), columns).size(),
              static_cast<std::size_t>(std::max(columns, 1)))
        << columns;
}

TEST(Bar, ShowsHowFarTheCheckOfAWholePictureIs) {
  v1::Progress check = progress_of(100, 100, 1, 1, 9);
  check.set_tiles_verified(40);
  EXPECT_EQ(bar(check, 200).substr(41), "]   40 %  verified  0:09 left");
}

TEST(Bar, KnowsNoRateBeforeTheFirstSecond) {
  EXPECT_EQ(bar(progress_of(0, 0, 0, 0, 0), 30), "  0 %  - Mrays/s  0:00 left");
}

TEST(Json, KeepsDefaultsAndWordsAndLeavesPixelsOut) {
  v1::JobEvent event;
  event.set_job_id(3);
  event.set_sequence(9);
  event.mutable_tile()->set_x(8);
  event.mutable_tile()->set_xyz("pixels");
  EXPECT_EQ(to_json(event).dump(),
            R"({"job_id":3,"sequence":9,"time":0.0,"tile":{"x":8,"y":0,"width":0,"height":0}})");

  v1::JobSummary job;
  job.set_state(v1::RUNNING);
  job.set_last_sequence(1ull << 40);
  EXPECT_EQ(to_json(job)["state"], "running");
  EXPECT_EQ(to_json(job)["last_sequence"], 1ull << 40);

  v1::Failed failed;
  failed.set_kind(v1::Failed::BAD_INPUT);
  failed.add_problem()->set_line(4);
  EXPECT_EQ(to_json(failed)["kind"], "bad-input");
  EXPECT_EQ(to_json(failed)["problem"][0]["line"], 4);
}

TEST(Json, WritesDigestsInHex) {
  v1::Plan plan;
  plan.set_scene_digest(std::string(32, '\x0f'));
  std::string hex;
  for (int i = 0; i < 32; ++i) hex += "0f";
  EXPECT_EQ(to_json(plan)["scene_digest"], hex);
}

}  // namespace
}  // namespace metamer::cli
