// A job's way through the daemon, with a worker that paints (x, y, 1) into each pixel.

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "../daemon.h"

namespace metamer::service::test {

namespace {

/// What a watcher has put together.
struct Picture {
  std::vector<float> xyz;
  std::vector<int> times;  // that a pixel came
  explicit Picture(std::size_t pixels) : xyz(pixels * 3), times(pixels) {}

  void add(const v1::Tile& tile, std::uint32_t width) {
    ASSERT_EQ(tile.xyz().size(), std::size_t{tile.width()} * tile.height() * 12);
    const char* from = tile.xyz().data();
    for (std::uint32_t y = tile.y(); y < tile.y() + tile.height(); ++y) {
      for (std::uint32_t x = tile.x(); x < tile.x() + tile.width(); ++x, from += 12) {
        const std::size_t pixel = std::size_t{y} * width + x;
        std::memcpy(&xyz[pixel * 3], from, 12);
        ++times[pixel];
      }
    }
  }
  void expect_painted(std::uint32_t width) const {
    for (std::size_t i = 0; i < times.size(); ++i) {
      ASSERT_EQ(times[i], 1) << "pixel " << i;
      ASSERT_EQ(xyz[i * 3], static_cast<float>(i % width));
      ASSERT_EQ(xyz[i * 3 + 1], static_cast<float>(i / width));
      ASSERT_EQ(xyz[i * 3 + 2], 1.0f);
    }
  }
};

}  // namespace

TEST(JobFlow, AJobIsRenderedAndItsWatcherGetsEveryPixelOnce) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const auto job = client.submit("picture 100 70 16");
  client.watch(job);
  Picture picture(100 * 70);
  std::vector<int> kinds;
  std::uint64_t sequence = 0;
  while (true) {
    const v1::JobEvent event = client.receive_event();
    EXPECT_EQ(event.job_id(), job);
    EXPECT_GT(event.sequence(), sequence);
    sequence = event.sequence();
    if (event.has_tile()) {
      picture.add(event.tile(), 100);
    } else if (!event.has_progress()) {
      kinds.push_back(event.event_case());
    }
    if (event.has_progress()) {
      EXPECT_EQ(event.progress().tiles(), 35u);
    }
    if (event.has_finished()) {
      EXPECT_EQ(event.finished().timing().rays(), 350u);
      EXPECT_EQ(event.finished().timing().compile(), 0.25);
      EXPECT_GE(event.finished().timing().queued(), 0);
      EXPECT_GT(event.finished().timing().total(), 0);
      break;
    }
  }
  picture.expect_painted(100);
  EXPECT_EQ(kinds, (std::vector<int>{v1::JobEvent::kQueued, v1::JobEvent::kStarted,
                                     v1::JobEvent::kPlanned, v1::JobEvent::kFinished}));
  EXPECT_EQ(client.summary(job).state(), v1::FINISHED);
}

namespace {

bool ends(const v1::JobEvent& event) {
  return event.has_finished() || event.has_failed() || event.has_cancelled();
}

/// Waits until the worker stands at its gate after `tiles` tiles.
void wait_for_tiles(Client& client, int tiles) {
  while (tiles > 0) tiles -= client.receive_event().has_tile();
}

v1::Envelope order(std::uint64_t job, const char* what) {
  v1::Envelope message;
  if (what == std::string("cancel")) message.mutable_cancel()->set_job_id(job);
  if (what == std::string("pause")) message.mutable_pause()->set_job_id(job);
  if (what == std::string("resume")) message.mutable_resume()->set_job_id(job);
  return message;
}

}  // namespace

TEST(JobFlow, CheckOnlyEndsWithThePlan) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  client.watch(client.submit("picture 100 70 16", true));
  const auto planned = client.receive_event_until([](auto& event) { return event.has_planned(); });
  EXPECT_EQ(planned.planned().plan().width(), 100u);
  EXPECT_TRUE(client.receive_event().has_finished());
}

TEST(JobFlow, ABrokenPromiseBeginsAgainWithTheBetterMethodAndWithoutTheTiles) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  client.watch(client.submit("picture 32 16 16 broken"));
  const auto again = client.receive_event_until([](auto& event) { return event.has_retrying(); });
  EXPECT_TRUE(again.retrying().from_start());
  const auto plan = client.receive_event_until([](auto& event) { return event.has_planned(); });
  EXPECT_TRUE(plan.planned().plan().method().has_exact());
  Picture picture(32 * 16);
  client.receive_event_until([&](auto& event) {
    if (event.has_tile()) picture.add(event.tile(), 32);
    return event.has_finished();
  });
  picture.expect_painted(32);

  // Who comes late sees the second picture only.
  client.watch(1);
  int tiles = 0;
  client.receive_event_until([&](auto& event) {
    tiles += event.has_tile();
    return event.has_finished();
  });
  EXPECT_EQ(tiles, 2);
}

TEST(JobFlow, FactorsComeWithTheTilesToWhoAsksForThem) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const std::uint64_t job = client.submit("picture 32 16 16 factors 250", false, true);
  for (const bool wanted : {true, false}) {
    client.watch(job, 0, true, false, wanted);
    const std::string expected(wanted ? 250 : 0, 'f');
    const auto plan = client.receive_event_until([](auto& event) { return event.has_planned(); });
    EXPECT_EQ(plan.planned().factors(), expected);
    client.receive_event_until([&](auto& event) {
      if (event.has_tile()) {
        EXPECT_EQ(event.tile().factors(), expected);
      }
      return event.has_finished();
    });
  }
}

TEST(JobFlow, MoreFactorsThanATileMayHaveFailTheJob) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  client.watch(client.submit("picture 32 16 16 factors 4000000", false, true));
  const auto failed = client.receive_event_until([](auto& event) { return event.has_failed(); });
  EXPECT_NE(failed.failed().reason().find("more factors than a tile may have"), std::string::npos)
      << failed.failed().reason();
}

TEST(JobFlow, CancelTakesEffectAtOnceAndTheNextJobRenders) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const auto job = client.submit("gate 3");
  const auto next = client.submit("picture 64 48 16");
  client.watch(job);
  wait_for_tiles(client, 3);
  const v1::Envelope answer = client.ask(order(job, "cancel"));  // its worker stands at the gate
  EXPECT_EQ(answer.job_summary().state(), v1::CANCELLED);
  EXPECT_TRUE(client.receive_event_until(ends).has_cancelled());
  client.watch(next);
  EXPECT_TRUE(client.receive_event_until(ends).has_finished());
  EXPECT_EQ(client.ask(order(job, "cancel")).error().message(),
            "job 1 is cancelled and can't be cancelled");
}

TEST(JobFlow, AWorkerThatIgnoresStopJobIsEnded) {
  Daemon daemon([](ServiceOptions& options) {
    options.worker.stop_timeout = std::chrono::milliseconds(200);
  });
  Client client(daemon.socket());
  client.hello();
  const auto job = client.submit("gate 3 deaf");
  const auto next = client.submit("picture 64 48 16");
  client.watch(job);
  wait_for_tiles(client, 3);
  client.ask(order(job, "cancel"));
  EXPECT_TRUE(client.receive_event_until(ends).has_cancelled());
  client.watch(next);
  EXPECT_TRUE(client.receive_event_until(ends).has_finished());
  v1::Envelope info;
  info.mutable_get_info();
  EXPECT_EQ(client.ask(info).info().worker(0).last_exit(), "did not stop within 0.2 s");
}

TEST(JobFlow, APausedJobKeepsItsTilesAndRendersTheRestWhenResumed) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const auto job = client.submit("picture 100 70 16 gate 9 once");
  client.watch(job);
  wait_for_tiles(client, 9);
  EXPECT_EQ(client.ask(order(job, "pause")).job_summary().state(), v1::PAUSED);
  EXPECT_EQ(client.ask(order(job, "pause")).error().message(),
            "job 1 is paused and can't be paused");
  EXPECT_EQ(client.ask(order(job, "pause")).error().code(), v1::Error::STATE);
  EXPECT_EQ(client.summary(job).tiles_done(), 9u);

  // Another job renders meanwhile.
  const auto other = client.submit("picture 64 48 16");
  Client watcher(daemon.socket());
  watcher.hello();
  watcher.watch(other);
  EXPECT_TRUE(watcher.receive_event_until(ends).has_finished());

  EXPECT_EQ(client.ask(order(job, "resume")).job_summary().tiles_done(), 9u);
  int tiles = 9;
  while (true) {
    const v1::JobEvent event = client.receive_event();
    tiles += event.has_tile();
    if (ends(event)) break;
  }
  EXPECT_EQ(tiles, 35);
  watcher.watch(job);
  Picture picture(100 * 70);
  while (true) {
    const v1::JobEvent event = watcher.receive_event();
    if (event.has_tile()) picture.add(event.tile(), 100);
    if (event.has_finished()) break;
  }
  picture.expect_painted(100);
}

TEST(JobFlow, AQueuedJobCanBePausedAndCancelled) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const auto first = client.submit("gate 1");
  const auto second = client.submit("picture 64 48 16");
  const auto third = client.submit("picture 64 48 16");
  EXPECT_EQ(client.ask(order(second, "pause")).job_summary().state(), v1::PAUSED);
  EXPECT_EQ(client.ask(order(third, "cancel")).job_summary().state(), v1::CANCELLED);
  EXPECT_EQ(client.ask(order(first, "resume")).error().message(),
            "job 1 is running and can't be resumed");
  daemon.open_gate();
  client.watch(first);
  EXPECT_TRUE(client.receive_event_until(ends).has_finished());
  EXPECT_EQ(client.summary(second).state(), v1::PAUSED);
  client.ask(order(second, "resume"));
  client.watch(second);
  EXPECT_TRUE(client.receive_event_until(ends).has_finished());
}

TEST(JobFlow, AJobOutlivesItsClientAndIsWatchedFromANumberOn) {
  Daemon daemon;
  std::uint64_t job = 0;
  std::uint64_t seen = 0;
  Picture picture(100 * 70);
  {
    Client client(daemon.socket());
    client.hello();
    job = client.submit("picture 100 70 16 gate 20");
    client.watch(job);
    for (int tiles = 0; tiles < 10;) {
      const v1::JobEvent event = client.receive_event();
      seen = event.sequence();
      if (!event.has_tile()) continue;
      picture.add(event.tile(), 100);
      ++tiles;
    }
  }
  daemon.open_gate();
  Client again(daemon.socket());
  again.hello();
  again.watch(job, seen + 1);
  while (true) {
    const v1::JobEvent event = again.receive_event();
    EXPECT_GT(event.sequence(), seen);
    if (event.has_tile()) picture.add(event.tile(), 100);
    if (event.has_finished()) break;
  }
  picture.expect_painted(100);
}

TEST(JobFlow, AWatcherThatReadsNothingHoldsNobodyUp) {
  Daemon daemon;
  Client slow(daemon.socket());
  slow.hello();
  // 12 MB of tiles: far more than the sockets' buffers hold.
  const auto job = slow.submit("picture 1000 1000 64 gate 1");
  slow.watch(job);
  Client fast(daemon.socket());
  fast.hello();
  fast.watch(job);
  daemon.open_gate();
  Picture picture(1000 * 1000);
  while (true) {
    const v1::JobEvent event = fast.receive_event();
    if (event.has_tile()) picture.add(event.tile(), 1000);
    if (event.has_finished()) break;
  }
  picture.expect_painted(1000);
  fast.ping();

  // And the slow one, when it reads at last, has lost nothing.
  Picture late(1000 * 1000);
  while (true) {
    const v1::JobEvent event = slow.receive_event();
    if (event.has_tile()) late.add(event.tile(), 1000);
    if (event.has_finished()) break;
  }
  late.expect_painted(1000);
}

TEST(JobFlow, PreviewsComeToThoseWhoWantThem) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const auto job = client.submit("picture 1000 500 64 gate 0");
  client.watch(job, 0, false, true);
  client.ping();  // the watch is there
  daemon.open_gate();
  bool seen = false;
  while (true) {
    const v1::JobEvent event = client.receive_event();
    EXPECT_FALSE(event.has_tile());
    if (event.has_preview()) {
      seen = true;
      EXPECT_EQ(event.preview().width(), 250u);
      EXPECT_EQ(event.preview().height(), 125u);
      EXPECT_EQ(event.preview().rgb().size(), 250u * 125 * 3);
    }
    if (ends(event)) break;
  }
  EXPECT_TRUE(seen);
}

TEST(JobFlow, APictureOfManyTilesIsRenderedInSeveralBatches) {
  Daemon daemon([](ServiceOptions& options) { options.worker.tiles_per_batch = 10; });
  Client client(daemon.socket());
  client.hello();
  client.watch(client.submit("picture 100 70 16"));
  Picture picture(100 * 70);
  while (true) {
    const v1::JobEvent event = client.receive_event();
    if (event.has_tile()) picture.add(event.tile(), 100);
    if (event.has_finished()) break;
  }
  picture.expect_painted(100);
}

}  // namespace metamer::service::test
