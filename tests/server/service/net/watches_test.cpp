// The jobs that one session watches: how long a watched job lives, by itself and through a socket.

#include "server/service/net/watches.h"

#include <gtest/gtest.h>

#include "../daemon.h"
#include "server/service/limits.h"
#include "server/service/ops/folders.h"

namespace metamer::service {

namespace {

class WatchesTest : public testing::Test {
 protected:
  TemporaryFolder folder_ = TemporaryFolder::make().value();
  std::shared_ptr<AssetStore> store_ = AssetStore::open(folder_.path() / "store", 1000).value();

  std::shared_ptr<Job> make_job(std::uint64_t id) {
    return std::make_shared<Job>(id, v1::Submit(), AssetHolds(*store_), 0);
  }
  static v1::Watch with_previews() {
    v1::Watch request;
    request.set_previews(true);
    return request;
  }
};

}  // namespace

TEST_F(WatchesTest, AWatcherKeepsItsJob) {
  auto job = make_job(1);
  const std::weak_ptr<Job> observed = job;
  {
    const Job::Watcher watcher(std::move(job), true, [] {});
    EXPECT_FALSE(observed.expired());
    EXPECT_EQ(watcher.job().id(), 1u);
  }
  EXPECT_TRUE(observed.expired());
}

TEST_F(WatchesTest, AWatchWhoseJobWasDroppedEndsBesideOthers) {
  int woken = 0;
  Watches watches([&] { ++woken; });
  auto dropped = make_job(1);
  const auto kept = make_job(2);
  watches.add(10, with_previews(), dropped);
  watches.add(20, with_previews(), kept);
  EXPECT_TRUE(dropped->cancel());
  const std::weak_ptr<Job> observed = dropped;
  dropped.reset();

  // Both were queued; then the first ends, and with its last event it goes.
  std::vector<std::uint64_t> requests;
  while (const auto event = watches.next()) requests.push_back(event->request_id());
  EXPECT_EQ(requests, (std::vector<std::uint64_t>{20, 10, 10}));
  EXPECT_EQ(watches.size(), 1u);
  EXPECT_TRUE(observed.expired());

  // The other is watched on.
  woken = 0;
  EXPECT_TRUE(kept->start());
  EXPECT_EQ(woken, 1);
  EXPECT_EQ(watches.next()->request_id(), 20u);
}

namespace test {

TEST(WatchFlow, AJobThatIsDroppedWhileItsWatcherDoesNotReadIsReadToItsEnd) {
  Daemon daemon;
  Client slow(daemon.socket());
  slow.hello();
  Client fast(daemon.socket());
  fast.hello();
  const auto ends = [](const v1::JobEvent& event) { return event.has_finished(); };

  // 12 MB of tiles: far more than the sockets' buffers hold.
  const auto first = fast.submit("picture 1000 1000 64");
  fast.watch(first, 0, false);
  fast.receive_event_until(ends);
  slow.watch(first);
  slow.receive_event();

  // It is dropped for those that end after it.
  for (std::size_t i = 0; i <= max_ended_jobs; ++i) {
    fast.watch(fast.submit("picture 64 48 16", true), 0, false);
    fast.receive_event_until(ends);
  }
  EXPECT_EQ(fast.summary(first).job_id(), 0u);

  const auto other = fast.submit("gate 1");
  slow.watch(other, 0, false);
  std::size_t tiles = 0;
  while (true) {
    const v1::JobEvent event = slow.receive_event();
    if (event.job_id() != first) continue;
    tiles += event.has_tile();
    if (event.has_finished()) break;
  }
  EXPECT_EQ(tiles, 256u);
  slow.ping();

  daemon.open_gate();
  slow.receive_event_until(ends);
}

v1::Envelope unwatch(std::uint64_t watch) {
  v1::Envelope message;
  message.mutable_unwatch()->set_watch(watch);
  return message;
}

TEST(WatchFlow, AWatchThatIsEndedGivesItsPlaceBackAndSaysNoMore) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const auto job = client.submit("gate 1");
  std::vector<std::uint64_t> watches;
  for (std::size_t i = 0; i < max_watches; ++i) watches.push_back(client.watch(job, 0, false));
  v1::Envelope one_more;
  one_more.mutable_watch()->set_job_id(job);
  EXPECT_EQ(client.ask(one_more).error().code(), v1::Error::LIMIT);

  // All but the first, many times over: the job goes on, and its end is told once.
  for (int round = 0; round < 5; ++round) {
    for (std::size_t i = 1; i < max_watches; ++i) {
      const v1::Envelope answer = client.ask(unwatch(watches[i]));
      EXPECT_TRUE(answer.has_unwatched()) << answer.ShortDebugString();
      if (round < 4) watches[i] = client.watch(job, 0, false);
    }
  }
  daemon.open_gate();
  client.receive_event_until([](const v1::JobEvent& event) { return event.has_finished(); });
  const auto other = client.submit("picture 64 48 16", true);
  client.watch(other);
  const auto last = client.receive_event_until([](const v1::JobEvent& event) {
    return event.has_finished();  // the first one's second end, if there were one
  });
  EXPECT_EQ(last.job_id(), other);
}

TEST(WatchFlow, OnlyAWatchOfOnesOwnThatGoesOnCanBeEnded) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  Client other(daemon.socket());
  other.hello();
  const auto job = client.submit("gate 1");
  const auto watch = client.watch(job);
  client.receive_event();
  const v1::Envelope refused = other.ask(unwatch(watch));
  EXPECT_EQ(refused.error().code(), v1::Error::NOT_FOUND);
  EXPECT_EQ(refused.error().message(),
            "there is no watch " + std::to_string(watch) + ", or it has ended");
  daemon.open_gate();
  client.receive_event_until([](const v1::JobEvent& event) { return event.has_finished(); });
  EXPECT_EQ(client.ask(unwatch(watch)).error().code(), v1::Error::NOT_FOUND);
  client.ping();
}

}  // namespace test

}  // namespace metamer::service
