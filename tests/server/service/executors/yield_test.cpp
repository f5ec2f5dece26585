// A job that has had its turn gives way to another user's, and loses nothing by it.

#include <gtest/gtest.h>

#include <map>

#include "../daemon.h"

namespace metamer::service::test {

namespace {

using std::chrono::milliseconds;

/// Two users: one by the Unix socket, one by TCP. A turn is over at once.
class Yield : public testing::Test {
 protected:
  Daemon daemon_{[](ServiceOptions& options) { options.worker.quantum = milliseconds(0); }};
  Client one_{daemon_.socket()};
  Client other_{daemon_.port()};
  void SetUp() override {
    one_.hello();
    other_.hello();
  }
  /// A job that waits at the gate after its first five tiles.
  std::uint64_t job_at_the_gate(Client& client, const std::string& more = {}) {
    const auto job = client.submit("gate 5 " + more);
    client.watch(job);
    for (int tiles = 0; tiles < 5;) tiles += client.receive_event().has_tile();
    return job;
  }
  static v1::Envelope with_priority(const std::string& scene, std::int32_t priority) {
    v1::Envelope message;
    message.mutable_submit()->set_scene_sha256(scene);
    message.mutable_submit()->set_priority(priority);
    return message;
  }
};

bool is_yield(const v1::JobEvent& event) {
  return event.has_queued() && event.queued().reason() == "others have their turn";
}
bool is_finished(const v1::JobEvent& event) { return event.has_finished(); }

}  // namespace

TEST(WorkOfADay, AJobThatGoesBeyondItWaitsWithItsTiles) {
  Daemon daemon([](ServiceOptions& options) {
    options.worker.quantum = milliseconds(0);
    options.limits.user_work = 1;
  });
  Client client(daemon.port());  // by a Unix socket it would be an admin
  client.hello();
  const auto job = client.submit("gate 5");
  client.watch(job);
  for (int tiles = 0; tiles < 5;) tiles += client.receive_event().has_tile();
  const v1::JobEvent held = client.receive_event_until(
      [](auto& event) { return event.has_queued() && event.sequence() > 1; });
  EXPECT_NE(held.queued().reason().find("of 1 s of workers within a day"), std::string::npos)
      << held.queued().reason();
  const v1::JobSummary summary = client.summary(job);
  EXPECT_EQ(summary.state(), v1::QUEUED);
  EXPECT_GE(summary.tiles_done(), 5u);
  EXPECT_NE(summary.reason().find("within a day"), std::string::npos);

  Client admin(daemon.socket());
  admin.hello();
  const auto allowed = admin.submit("picture 8 8 8");
  admin.watch(allowed);
  admin.receive_event_until(is_finished);
}

TEST_F(Yield, ItCostsNoAttemptAndNoTile) {
  const auto job = job_at_the_gate(one_, "verify");
  const auto short_job = other_.submit("picture 8 8 8");
  other_.watch(short_job);
  EXPECT_TRUE(is_yield(one_.receive_event_until([](auto& event) { return event.has_queued(); })));
  other_.receive_event_until(is_finished);
  daemon_.open_gate();
  int tiles = 5;
  v1::JobEvent event;
  do {
    event = one_.receive_event();
    tiles += event.has_tile();
    EXPECT_FALSE(event.has_retrying() || event.has_planned() || event.has_failed());
    EXPECT_LE(event.started().attempt(), 1u);
  } while (!event.has_finished());
  EXPECT_EQ(tiles, 12);
  EXPECT_TRUE(event.finished().accuracy().kept());  // the memory held the tiles of both turns
  EXPECT_EQ(one_.info().worker(0).starts(), 1u);
  EXPECT_GT(one_.summary(job).worker_seconds(), 0);
}

TEST_F(Yield, TheChosenMethodStays) {
  // Its promise is broken, so it goes on with `exact`; after the turn it is asked for that again.
  const auto job = one_.submit("gate 5 broken");
  one_.watch(job);
  daemon_.open_gate();
  one_.receive_event_until([](auto& event) { return event.has_retrying(); });
  one_.receive_event_until([](auto& event) { return event.has_planned(); });
  for (int tiles = 0; tiles < 5;) tiles += one_.receive_event().has_tile();
  other_.watch(other_.submit("picture 8 8 8"));
  one_.receive_event_until(is_yield);
  other_.receive_event_until(is_finished);
  daemon_.open_gate();
  const auto end = one_.receive_event_until(
      [](auto& event) { return event.has_finished() || event.has_retrying(); });
  EXPECT_TRUE(end.has_finished());
}

TEST_F(Yield, NobodyGivesWayToHisOwnLaterJobButToAnUrgentOne) {
  const auto job = job_at_the_gate(one_);
  const std::string scene = one_.upload({"picture 8 8 8"})[0];
  const auto later = one_.ask(with_priority(scene, 0)).submitted().job_id();
  // Beats have come meanwhile: four a second in a worker, twenty here.
  const double before = one_.summary(job).worker_seconds();
  while (one_.summary(job).worker_seconds() < before + 0.2) {
  }
  EXPECT_EQ(one_.summary(job).state(), v1::RUNNING);
  const auto urgent = one_.ask(with_priority(scene, 1)).submitted().job_id();
  one_.receive_event_until(is_yield);
  one_.watch(urgent);
  one_.receive_event_until(
      [&](auto& event) { return event.has_finished() && event.job_id() == urgent; });
  EXPECT_EQ(one_.summary(later).state(), v1::QUEUED);
  daemon_.open_gate();
}

TEST_F(Yield, TheGreedyAndTheModestGetEqualTime) {
  // One has many jobs, the other one at a time: they have turns.
  std::vector<std::uint64_t> greedy;
  const auto first = job_at_the_gate(one_);
  for (int i = 0; i < 20; ++i) greedy.push_back(one_.submit("picture 8 8 8"));
  const auto modest = other_.submit("picture 8 8 8");
  other_.watch(modest);
  other_.receive_event_until(is_finished);
  int ended = 0;
  for (const auto job : greedy) ended += one_.summary(job).state() == v1::FINISHED;
  EXPECT_LE(ended, 1);
  daemon_.open_gate();
  one_.watch(first, 0, false);
  one_.receive_event_until(is_finished);
}

TEST_F(Yield, WhatIsCancelledOrPausedMeanwhileStaysThat) {
  for (int round = 0; round < 10; ++round) {
    const auto job = job_at_the_gate(one_);
    const auto rival = other_.submit("picture 8 8 8");
    v1::Envelope order;
    if (round % 2 == 0)
      order.mutable_cancel()->set_job_id(job);
    else
      order.mutable_pause()->set_job_id(job);
    const auto answer = one_.ask(order);
    ASSERT_TRUE(answer.has_job_summary()) << answer.ShortDebugString();
    other_.watch(rival);
    other_.receive_event_until(
        [&](auto& event) { return event.has_finished() && event.job_id() == rival; });
    EXPECT_EQ(one_.summary(job).state(), round % 2 == 0 ? v1::CANCELLED : v1::PAUSED);
    if (round % 2 == 0) continue;
    order.mutable_cancel()->set_job_id(job);
    one_.ask(order);
  }
}

}  // namespace metamer::service::test
