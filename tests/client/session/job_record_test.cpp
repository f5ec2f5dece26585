// A job's events become its record; what a server leaves out of it is an error.
#include "client/session/record_job.h"

#include <gtest/gtest.h>

#include "client/session/connect.h"
#include "client/session/problems.h"
#include "fake_server.h"

namespace metamer::test {
namespace {

namespace asio = boost::asio;
using Kind = SessionError::Kind;

v1::JobEvent planned(std::uint32_t width, std::uint32_t height) {
  v1::JobEvent event;
  event.mutable_planned()->mutable_plan()->set_width(width);
  event.mutable_planned()->mutable_plan()->set_height(height);
  return event;
}

v1::JobEvent tile(std::uint32_t x, std::uint32_t width) {
  v1::JobEvent event;
  event.mutable_tile()->set_x(x);
  event.mutable_tile()->set_width(width);
  event.mutable_tile()->set_height(1);
  event.mutable_tile()->set_xyz(std::string(width * 3 * sizeof(float), '\0'));
  return event;
}

v1::JobEvent finished(std::uint64_t rays) {
  v1::JobEvent event;
  event.mutable_finished()->mutable_timing()->set_rays(rays);
  return event;
}

/// The error of the first event that is refused; of the whole record else; empty: all is well.
std::string error_of(const std::vector<v1::JobEvent>& events, JobParts parts) {
  JobRecord record;
  for (const v1::JobEvent& event : events)
    if (const Answer<void> taken = take(event, parts, record); !taken) return taken.error().message;
  const Answer<void> whole = complete(record, parts);
  return whole ? "" : whole.error().message;
}

TEST(JobRecord, KeepsThePlanThePictureAndTheEnd) {
  JobRecord record;
  for (const v1::JobEvent& event : {planned(4, 1), tile(2, 2), tile(0, 2), finished(9)})
    ASSERT_TRUE(take(event, JobParts::picture, record));
  EXPECT_EQ(record.plan->width(), 4u);
  EXPECT_TRUE(record.film->complete());
  EXPECT_FALSE(record.factors);
  EXPECT_EQ(record.last.finished().timing().rays(), 9u);
  EXPECT_TRUE(complete(record, JobParts::picture));
}

TEST(JobRecord, ANewPlanBeginsANewPicture) {
  EXPECT_EQ(error_of({planned(2, 1), tile(0, 2), planned(2, 1), tile(0, 2), finished(1)},
                     JobParts::picture),
            "");
}

TEST(JobRecord, APlanAloneKeepsNoTiles) {
  JobRecord record;
  for (const v1::JobEvent& event : {planned(4, 1), tile(0, 2), finished(0)})
    ASSERT_TRUE(take(event, JobParts::plan, record));
  EXPECT_FALSE(record.film);
  EXPECT_TRUE(complete(record, JobParts::plan));
}

TEST(JobRecord, WhatAServerLeavesOutIsAnError) {
  EXPECT_EQ(error_of({tile(0, 2)}, JobParts::picture), "the server sent a tile before its plan");
  EXPECT_EQ(error_of({planned(4, 1), tile(0, 2), finished(9)}, JobParts::picture),
            "the server finished the job without all of its tiles");
  EXPECT_EQ(error_of({planned(4, 1), finished(0)}, JobParts::picture),
            "the job has no picture: it was checked or explained only");
  EXPECT_EQ(error_of({finished(9)}, JobParts::picture),
            "the server finished the job without all of its tiles");
  v1::JobEvent factors = planned(4, 1);
  factors.mutable_planned()->set_factors("\xff");
  EXPECT_EQ(error_of({factors}, JobParts::picture_and_factors),
            "the server sent factors of no scene");
}

TEST(JobRecord, AJobThatFailedNeedsNoPicture) {
  v1::JobEvent failed;
  failed.mutable_failed();
  EXPECT_EQ(error_of({planned(4, 1), failed}, JobParts::picture), "");
}

TEST(JobRecord, IsWatchedFromTheFirstEventToTheLast) {
  v1::Watch asked;
  FakeServer server([&](const v1::Envelope& request) -> std::vector<v1::Envelope> {
    if (!request.has_watch()) return {welcome()};
    asked = request.watch();
    std::vector<v1::Envelope> answers(3);
    *answers[0].mutable_job_event() = planned(2, 1);
    *answers[1].mutable_job_event() = tile(0, 2);
    *answers[2].mutable_job_event() = finished(1);
    return answers;
  });
  std::size_t shown = 0;
  const auto failure = server.run([&](Session& session) -> asio::awaitable<void> {
    const std::function<void(const v1::JobEvent&)> show = [&](const v1::JobEvent&) { ++shown; };
    const Answer<JobRecord> record = co_await record_job(session, 7, JobParts::picture, show);
    EXPECT_TRUE(record);
    EXPECT_EQ(record ? record->job.number : 0, 7u);
  });
  EXPECT_FALSE(failure);
  EXPECT_EQ(asked.job_id(), 7u);
  EXPECT_TRUE(asked.tiles());
  EXPECT_FALSE(asked.factors());
  EXPECT_EQ(shown, 3u);
}

TEST(Connect, ToANamedServerStartsNoneOfOurOwn) {
  asio::io_context loop(1);
  bool ended = false;
  asio::co_spawn(
      loop,
      [&]() -> asio::awaitable<void> {
        const Answer<Connection> nobody = co_await connect("unix:/nobody/listens/here");
        EXPECT_EQ(nobody ? Kind::refused : nobody.error().kind, Kind::no_server);
        const Answer<Connection> no_address = co_await connect("unix:");
        EXPECT_EQ(no_address ? Kind::refused : no_address.error().kind, Kind::input);
        ended = true;
      },
      asio::detached);
  loop.run();
  EXPECT_TRUE(ended);
}

TEST(Problems, ComeOverTheWireWhole) {
  v1::Failed failed;
  v1::Problem& problem = *failed.add_problem();
  problem.set_field("light[0].name");
  problem.set_file("a.txtpb");
  problem.set_line(3);
  problem.set_column(4);
  problem.set_message("is empty");
  const std::vector<Problem> problems = from_wire(failed.problem());
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(format(problems[0]), "a.txtpb:3:4: error: is empty");
}

}  // namespace
}  // namespace metamer::test
