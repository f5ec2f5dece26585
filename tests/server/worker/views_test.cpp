#include "server/worker/views.h"

#include <algorithm>
#include <condition_variable>
#include <thread>

#include "tests/server/worker/worker_fixture.h"

namespace metamer::worker {
namespace {

class WorkerViews : public WorkerTest {
 protected:
  void open(std::uint64_t id, const std::string& scene) {
    v1::WorkerEnvelope message;
    message.mutable_open_view()->set_view_id(id);
    message.mutable_open_view()->mutable_open()->set_scene_sha256(store_scene(scene));
    EXPECT_TRUE(views_.take(message));
  }
  void next_frame(std::uint64_t id) {
    v1::WorkerEnvelope message;
    message.mutable_next_frame()->set_view_id(id);
    EXPECT_TRUE(views_.take(message));
  }
  void close(std::uint64_t id) {
    v1::WorkerEnvelope message;
    message.mutable_close_view()->set_view_id(id);
    EXPECT_TRUE(views_.take(message));
  }
  /// Serves until nothing is waiting and nothing is being imported, as the lane does.
  void settle() {
    for (;;) {
      while (views_.waiting()) views_.serve();
      if (!views_.importing()) return;
      std::unique_lock lock(mutex_);
      woken_.wait(lock, [&] { return views_.waiting(); });
    }
  }

  std::mutex mutex_;
  std::condition_variable woken_;
  Views views_{options_, link_, work_, [this] {
                 const std::lock_guard lock(mutex_);
                 woken_.notify_all();
               }};
};

TEST_F(WorkerViews, TakeNothingButWhatIsAboutThem) {
  v1::WorkerEnvelope message;
  message.mutable_stop_job();
  EXPECT_FALSE(views_.take(message));
  EXPECT_FALSE(views_.waiting());
}

TEST_F(WorkerViews, EachHasItsFrameInTurn) {
  open(1, ball_scene(small));
  open(2, ball_scene(small));
  settle();
  EXPECT_EQ(sent_names(), (Names{"view_event.updated", "view_event.updated"}));
  for (const std::uint64_t id : {1u, 1u, 2u}) next_frame(id);
  settle();
  std::vector<std::uint64_t> order;
  for (const v1::WorkerEnvelope& message : sent()) order.push_back(message.view_event().view_id());
  EXPECT_EQ(order, (std::vector<std::uint64_t>{1, 2, 1}));
}

TEST_F(WorkerViews, AreServedWhileAJobIsAtWorkElsewhere) {
  std::atomic<bool> drawn = false;
  backend_.before_tile = [&] { drawn = true; };
  open(1, ball_scene(small));
  next_frame(1);
  const std::uint64_t before = work_;
  views_.serve_while([&] {
    while (!drawn) std::this_thread::yield();
  });
  // Who watches the job for a hang is not told of frames.
  EXPECT_EQ(work_, before);
}

TEST_F(WorkerViews, OneThatIsClosedIsForgotten) {
  open(1, ball_scene(small));
  close(1);  // perhaps in the middle of its import
  next_frame(1);
  settle();
  for (const std::string& name : sent_names()) EXPECT_EQ(name, "view_event.updated");
  EXPECT_EQ(backend_.seen.pictures, 0);
}

TEST_F(WorkerViews, OneThatFailsLeavesTheOthers) {
  open(1, ball_scene(small));
  open(2, ball_scene(small, "object { name: 'ball' }"));
  settle();
  next_frame(1);
  next_frame(2);
  settle();
  const Names names = sent_names();
  EXPECT_EQ(std::count(names.begin(), names.end(), "view_event.closed"), 1);
  EXPECT_EQ(std::count(names.begin(), names.end(), "view_event.band"), 1);
}

}  // namespace
}  // namespace metamer::worker
