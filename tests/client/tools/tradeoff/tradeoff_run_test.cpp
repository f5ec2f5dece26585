// What ends a trade before its end, by a server that refuses, cancels, fails and goes.
#include "client/tools/tradeoff/tradeoff_run.h"

#include <gtest/gtest.h>

#include "tests/client/session/fake_server.h"

namespace metamer::client {
namespace {

namespace asio = boost::asio;
using Envelopes = std::vector<v1::Envelope>;
using StopKind = TradeoffStop::Kind;

/// A run against a server that has all assets and does `answer` to a submission and to a watch.
tl::expected<Tradeoff, TradeoffStop> run_against(test::FakeServer::AnswerTo answer,
                                                 std::vector<std::uint64_t>* jobs = nullptr) {
  test::FakeServer server([&](const v1::Envelope& request) {
    if (request.has_hello()) return Envelopes{test::welcome()};
    if (request.has_offer_assets()) {
      v1::Envelope reply;
      reply.mutable_missing_assets();
      return Envelopes{reply};
    }
    return answer(request);
  });
  tl::expected<Tradeoff, TradeoffStop> result;
  const v1::Scene scene;
  const std::vector<Asset> assets;
  TradeoffCalls calls;
  calls.round = [](unsigned, const Tradeoff&) {};
  calls.job = [&](std::optional<std::uint64_t> id) {
    if (jobs) jobs->push_back(id.value_or(0));
  };
  calls.measured = [](const TradeoffRow&, const Image&) { return Result<void>(); };
  const auto work = [&](Session& session) -> asio::awaitable<void> {
    const TradeoffScene sent{scene, assets, "scene"};
    result = co_await run_tradeoff(session, sent, 2, calls);
  };
  EXPECT_FALSE(server.run(work));
  return result;
}

/// Job 7 is taken, and ends by `event`.
test::FakeServer::AnswerTo ends_by(std::function<void(v1::JobEvent&)> event) {
  return [event](const v1::Envelope& request) {
    v1::Envelope reply;
    if (request.has_watch()) {
      reply.mutable_job_event()->set_sequence(1);
      event(*reply.mutable_job_event());
    } else {
      reply.mutable_submitted()->set_job_id(7);
    }
    return Envelopes{reply};
  };
}

/// Takes every job: a picture of one grey pixel, brighter in the second job, each job a second
/// quicker than the one before.
class QuickerAndQuicker {
 public:
  Envelopes operator()(const v1::Envelope& request) {
    v1::Envelope reply;
    if (!request.has_watch()) {
      reply.mutable_submitted()->set_job_id(++jobs_);
      return {reply};
    }
    v1::JobEvent planned, tile, finished;
    v1::Plan& plan = *planned.mutable_planned()->mutable_plan();
    plan.set_width(1);
    plan.set_height(1);
    const std::vector<float> xyz(3, jobs_ == 2 ? 0.4f : 0.2f);
    tile.mutable_tile()->set_width(1);
    tile.mutable_tile()->set_height(1);
    tile.mutable_tile()->set_xyz(xyz.data(), xyz.size() * sizeof(float));
    v1::Timing& timing = *finished.mutable_finished()->mutable_timing();
    timing.set_rays(1);
    timing.set_render(static_cast<double>(100 - jobs_));
    Envelopes events;
    for (v1::JobEvent* event : {&planned, &tile, &finished}) {
      event->set_sequence(events.size() + 1);
      *reply.mutable_job_event() = *event;
      events.push_back(reply);
    }
    return events;
  }

 private:
  std::uint64_t jobs_ = 0;
};

TEST(TradeoffRun, KeepsTheCheapestRoundAndTheErrorOfTheFirst) {
  const auto run = run_against(QuickerAndQuicker());
  ASSERT_TRUE(run) << run.error().error.message << run.error().problem.message;
  EXPECT_EQ(run->reference_seconds, 99);
  EXPECT_FALSE(run->white_of_plan);
  ASSERT_EQ(run->rows.size(), tradeoff_cases().size());
  for (std::size_t i = 0; i < run->rows.size(); ++i) {
    const TradeoffRow& row = run->rows[i];
    EXPECT_EQ(row.failure, "");
    // Its second job comes after the reference and a whole round.
    EXPECT_EQ(row.seconds(), 100. - static_cast<double>(1 + run->rows.size() + i + 1));
    EXPECT_EQ(row.error.maximum > 0, i == 0) << row.what.stem;
    EXPECT_EQ(row.front, i + 1 == run->rows.size()) << "the quickest has no error";
  }
}

TEST(TradeoffRun, ARefusedReferenceEndsIt) {
  const auto run = run_against([](const v1::Envelope&) {
    return Envelopes{test::error(v1::Error::LIMIT, "too many jobs")};
  });
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().kind, StopKind::reference);
  EXPECT_EQ(run.error().problem.message, "too many jobs");
}

TEST(TradeoffRun, AFailedReferenceSaysWhy) {
  const auto run = run_against(ends_by([](v1::JobEvent& event) {
    event.mutable_failed()->set_reason("no worker");
    v1::Problem& problem = *event.mutable_failed()->add_problem();
    problem.set_field("camera");
    problem.set_message("it looks nowhere");
  }));
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().kind, StopKind::reference);
  EXPECT_EQ(run.error().problem.message, "no worker: camera: it looks nowhere");
}

TEST(TradeoffRun, ACancelledJobCancelsIt) {
  std::vector<std::uint64_t> jobs;
  const auto run =
      run_against(ends_by([](v1::JobEvent& event) { event.mutable_cancelled(); }), &jobs);
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().kind, StopKind::cancelled);
  EXPECT_EQ(jobs, (std::vector<std::uint64_t>{7, 0})) << "under way, and no more";
}

TEST(TradeoffRun, ALostServerEndsIt) {
  const auto run = run_against([](const v1::Envelope&) { return Envelopes{{}}; });
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().kind, StopKind::session);
  EXPECT_EQ(run.error().error.kind, SessionError::Kind::disconnected);
}

}  // namespace
}  // namespace metamer::client
