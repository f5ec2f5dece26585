// A job's way through the daemon, with a worker that paints (x, y, 1) into each pixel.

#include <gtest/gtest.h>

#include <cstring>
#include <set>

#include "daemon.h"

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

}  // namespace metamer::service::test
