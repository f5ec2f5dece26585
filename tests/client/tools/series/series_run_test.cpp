// A series is one thing to its user, whatever becomes of each of its jobs.
#include "client/tools/series/series_run.h"

#include <gtest/gtest.h>

#include <deque>
#include <set>

#include "client/tools/series/series_list.h"
#include "tests/client/session/fake_server.h"

namespace metamer::client {
namespace {

namespace asio = boost::asio;
using test::FakeServer;
using Envelopes = std::vector<v1::Envelope>;

/// A server whose jobs end as a test says, each once the client has asked for something else.
struct Server {
  std::uint32_t watches = 3;
  std::set<std::uint32_t> failing, refused;  ///< By their index.
  std::uint32_t cancelled = ~0u;
  std::uint32_t room = 100;  ///< Jobs at a time.

  std::vector<v1::Submit> submitted;
  std::uint32_t live = 0, most_live = 0;
  unsigned cancels = 0;
  /// Of watches whose job goes on: ended by the next request.
  std::deque<v1::Envelope> open;

  v1::Envelope end_of(const v1::Envelope& watch) {
    const std::uint64_t id = watch.watch().job_id();
    v1::Envelope last;
    last.set_request_id(watch.request_id());
    v1::JobEvent& event = *last.mutable_job_event();
    event.set_job_id(id);
    event.set_sequence(9);
    const auto index = static_cast<std::uint32_t>(submitted[id - 1].series().index());
    if (index == cancelled) {
      event.mutable_cancelled();
    } else if (failing.contains(index)) {
      event.mutable_failed()->set_reason("no such luck");
    } else {
      event.mutable_finished();
    }
    return last;
  }
  Envelopes operator()(const v1::Envelope& request) {
    v1::Envelope answer;
    if (request.has_hello()) {
      answer = test::welcome();
      answer.mutable_welcome()->mutable_limits()->set_watches(watches);
      answer.mutable_welcome()->mutable_limits()->set_queued_jobs(256);
      return {answer};
    }
    if (request.has_offer_assets()) answer.mutable_missing_assets();
    if (request.has_cancel()) {
      ++cancels;
      answer.mutable_job_summary();
      const auto watch = std::find_if(open.begin(), open.end(), [&](const v1::Envelope& one) {
        return one.watch().job_id() == request.cancel().job_id();
      });
      v1::Envelope last = end_of(*watch);
      last.mutable_job_event()->mutable_cancelled();
      open.erase(watch);
      return {answer, last};
    }
    if (request.has_submit()) {
      if (live >= room) return {test::error(v1::Error::LIMIT, "the queue is full")};
      if (refused.contains(request.submit().series().index()))
        return {test::error(v1::Error::FORBIDDEN, "not for you")};
      submitted.push_back(request.submit());
      most_live = std::max(most_live, ++live);
      answer.mutable_submitted()->set_job_id(submitted.size());
      return {answer};
    }
    Envelopes answers;
    if (request.has_watch()) {
      open.push_back(request);
      v1::Envelope begun;
      begun.mutable_job_event()->set_job_id(request.watch().job_id());
      begun.mutable_job_event()->set_sequence(1);
      begun.mutable_job_event()->mutable_started();
      answers.push_back(begun);
      // The last ones have nobody to wait for.
      const bool full = live == std::min(watches, room);
      const bool all = submitted.back().series().index() + 1 == submitted.back().series().count();
      while (!open.empty() && (full || all)) {
        answers.push_back(end_of(open.front()));
        open.pop_front();
        --live;
        if (!all) break;
      }
    } else {
      answers.push_back(answer);
    }
    return answers;
  }
};

struct Outcome {
  Answer<SeriesCounts> counts;
  std::map<std::uint32_t, std::string> failures;  ///< By index; "": done.
  bool cancelled = false;
  double last_share = 0;
};

Outcome run(Server& answers, std::uint32_t count) {
  Outcome outcome;
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  const SeriesJobs jobs{
      .id = std::string(16, 'i'), .name = "a series", .count = count, .parts = JobParts::plan};
  EXPECT_FALSE(server.run([&](Session& session) -> asio::awaitable<void> {
    SeriesCalls calls;
    calls.make = [](std::uint32_t index) -> Result<Submission> {
      if (index == 77) return problem("no scene");
      return make_submission(v1::Scene(), {}, "scene", false);
    };
    calls.label = [](std::uint32_t index) { return "job " + std::to_string(index); };
    calls.ended = [&](std::uint32_t index, SeriesEnd end) {
      EXPECT_FALSE(outcome.failures.contains(index));
      outcome.failures[index] = !end                        ? end.error().message
                                : end->last.has_finished()  ? ""
                                : end->last.has_cancelled() ? "cancelled"
                                                            : end->last.failed().reason();
    };
    calls.progress = [&](const SeriesCounts& counts) {
      EXPECT_GE(counts.share, outcome.last_share - 1e-9);
      outcome.last_share = counts.share;
    };
    SeriesRun run(session, jobs, calls);
    outcome.counts = co_await run.run();
    outcome.cancelled = run.cancelled();
  }));
  return outcome;
}

TEST(SeriesRun, KeepsAFewJobsSubmittedAndEndsWithTheLast) {
  Server server;
  const Outcome outcome = run(server, 20);
  ASSERT_TRUE(outcome.counts) << outcome.counts.error().message;
  EXPECT_EQ(outcome.counts->done, 20u);
  EXPECT_EQ(outcome.failures.size(), 20u);
  EXPECT_EQ(outcome.last_share, 1);
  EXPECT_EQ(server.most_live, 3u) << "as many as may be watched";
  ASSERT_EQ(server.submitted.size(), 20u);
  for (std::uint32_t i = 0; i < 20; ++i) {
    const v1::Series& series = server.submitted[i].series();
    EXPECT_EQ(series.index(), i);
    EXPECT_EQ(series.count(), 20u);
    EXPECT_EQ(series.id(), std::string(16, 'i'));
    EXPECT_EQ(series.name(), "a series");
    EXPECT_EQ(series.label(), "job " + std::to_string(i));
  }
}

TEST(SeriesRun, OneThatFailsHasItsReasonAndOthersGoOn) {
  Server server;
  server.failing = {2};
  server.refused = {4};
  const Outcome outcome = run(server, 80);
  ASSERT_TRUE(outcome.counts);
  EXPECT_EQ(outcome.counts->done, 77u);
  EXPECT_EQ(outcome.counts->failed, 3u);
  EXPECT_EQ(outcome.failures.at(2), "no such luck");
  EXPECT_EQ(outcome.failures.at(4), "not for you");
  EXPECT_EQ(outcome.failures.at(77), "no scene");
}

TEST(SeriesRun, WaitsForItsOwnJobsWhereThereIsNoRoom) {
  Server server;
  server.room = 2;
  const Outcome outcome = run(server, 6);
  ASSERT_TRUE(outcome.counts);
  EXPECT_EQ(outcome.counts->done, 6u);
  EXPECT_EQ(server.most_live, 2u);
}

TEST(SeriesRun, OneThatSomebodyCancelsEndsThemAll) {
  Server server;
  server.cancelled = 5;
  const Outcome outcome = run(server, 20);
  ASSERT_TRUE(outcome.counts);
  EXPECT_TRUE(outcome.cancelled);
  EXPECT_EQ(outcome.counts->failed, 0u);
  EXPECT_EQ(outcome.counts->cancelled, 3u);
  EXPECT_LT(server.submitted.size(), 20u);
  EXPECT_EQ(server.cancels, 2u) << "those that were submitted beside it";
}

v1::JobSummary listed(std::uint64_t id, v1::JobState state, char series, std::uint32_t index) {
  v1::JobSummary job;
  job.set_job_id(id);
  job.set_state(state);
  job.set_user("ann");
  job.set_age(static_cast<double>(100 - id));
  if (series == 0) return job;
  job.mutable_series()->set_id(std::string(16, series));
  job.mutable_series()->set_name(std::string("series ") + series);
  job.mutable_series()->set_index(index);
  job.mutable_series()->set_count(9);
  return job;
}

TEST(SeriesList, CountsWhatBecameOfEachAndWhatIsGone) {
  v1::JobList list;
  *list.add_job() = listed(1, v1::FINISHED, 'a', 2);
  *list.add_job() = listed(2, v1::RUNNING, 0, 0);
  *list.add_job() = listed(3, v1::FAILED, 'b', 0);
  *list.add_job() = listed(4, v1::RUNNING, 'a', 4);
  list.mutable_job(3)->set_reason("1 task on n1");
  *list.add_job() = listed(5, v1::QUEUED, 'a', 5);
  const auto all = listed_series(list);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].series.name(), "series a");
  EXPECT_EQ(all[0].finished, 1u);
  EXPECT_EQ(all[0].live(), 2u);
  EXPECT_EQ(all[0].gone, 3u) << "0, 1 and 3";
  EXPECT_EQ(describe(all[0]),
            " series:61616161  running         1 of 9      1:39  cpu  ann  series a  (1 running: 1 "
            "task on n1; 1 queued; 3 not listed; 3 not submitted)");
  v1::JobList alone;
  *alone.add_job() = listed(1, v1::FINISHED, 'a', 0);
  EXPECT_NE(describe(listed_series(alone)[0]).find("  partial  "), std::string::npos);
  alone.mutable_job(0)->mutable_series()->set_count(1);
  EXPECT_NE(describe(listed_series(alone)[0]).find("  finished  "), std::string::npos);
  EXPECT_EQ(describe(all[1]),
            " series:62626262  failed          0 of 9      1:37  cpu  ann  series b  (1 failed; 8 "
            "not submitted)");
}

TEST(SeriesList, OneIsFoundByItsFirstBytesOrItsName) {
  v1::JobList list;
  *list.add_job() = listed(1, v1::FINISHED, 'a', 2);
  *list.add_job() = listed(2, v1::FINISHED, 'b', 2);
  list.mutable_job(1)->mutable_series()->set_name("series a");
  *list.add_job() = listed(3, v1::FINISHED, 'c', 2);
  const auto all = listed_series(list);
  for (const char* word : {"series:636363", "series:6363636363636363", "series:series c"})
    EXPECT_EQ(find_series(all, word)->series.name(), "series c") << word;
  for (const char* word : {"series:63636", "series:", "series:636362", "series:series d"})
    EXPECT_FALSE(find_series(all, word)) << word;
  EXPECT_EQ(find_series(all, "series:series a").error().message,
            "several series are called \"series a\": series:61616161 series:62626262");
  list.mutable_job(0)->set_state(v1::RUNNING);
  EXPECT_EQ(find_series(listed_series(list), "series:series a")->series.id()[0], 'a')
      << "the other has ended";
}

TEST(SeriesList, BelievesNoIndexOfAServer) {
  v1::JobList list;
  *list.add_job() = listed(1, v1::FINISHED, 'a', ~0u);
  EXPECT_EQ(listed_series(list)[0].gone, ~0u);
}

}  // namespace
}  // namespace metamer::client
