// What jobs take of memory together: who does not fit waits, who never fits is told so.

#include <gtest/gtest.h>

#include "../daemon.h"

namespace metamer::service::test {

namespace {

/// Room for one picture of 2048² pixels and its worker, 160 MiB, and not for two.
class Memory : public testing::Test {
 protected:
  Daemon daemon_{[](ServiceOptions& options) { options.limits.memory = 256u << 20; }};
  Client client_{daemon_.socket()};
  void SetUp() override { client_.hello(); }
  std::uint64_t submit(const std::string& script, v1::Backend backend) {
    v1::Envelope message;
    message.mutable_submit()->set_scene_sha256(client_.upload({script})[0]);
    message.mutable_submit()->set_backend(backend);
    return client_.ask(message).submitted().job_id();
  }
  static v1::Envelope open_view(Client& client, const std::string& script) {
    v1::Envelope message;
    message.mutable_open_view()->set_scene_sha256(client.upload({script})[0]);
    return message;
  }
};

}  // namespace

TEST_F(Memory, WhatDoesNotFitBesideAnotherWaitsForItsEnd) {
  const auto first = submit("picture 2048 2048 256 gate 1", v1::GL);
  client_.watch(first, 0, true);
  client_.receive_event_until([](auto& event) { return event.has_tile(); });
  const auto second = submit("picture 2048 2048 256", v1::CPU);
  client_.watch(second, 0, false);
  const auto held = client_.receive_event_until([&](auto& event) {
    return event.job_id() == second && event.queued().reason().starts_with("waits for memory");
  });
  EXPECT_EQ(held.queued().reason(),
            "waits for memory: it takes about 161 MiB, and of 256 MiB others have 161 MiB");
  EXPECT_EQ(client_.summary(second).state(), v1::QUEUED);
  EXPECT_EQ(client_.summary(second).reason(), held.queued().reason());
  daemon_.open_gate();
  // The first one's end may come before or after it.
  for (bool finished = false; !finished;) {
    const v1::JobEvent event = client_.receive_event();
    finished = event.job_id() == second && event.has_finished();
  }
  EXPECT_EQ(client_.summary(first).state(), v1::FINISHED);
}

TEST_F(Memory, AViewThatDoesNotFitBesideOthersIsRefusedAndAJobWaits) {
  // Each is a worker and a scene of 1100 KiB, 64 times as much in memory.
  const auto scene = [](char name) { return std::string(1100 << 10, name); };
  client_.send(open_view(client_, scene('a')));
  const v1::Envelope refused = client_.ask(open_view(client_, scene('b')));
  EXPECT_EQ(refused.error().code(), v1::Error::LIMIT);
  EXPECT_EQ(refused.error().message(),
            "the view takes about 133 MiB of memory, most of it for its objects and materials, and "
            "of 256 MiB others have 133 MiB");
  const auto job = submit("picture 2048 2048 256", v1::CPU);
  client_.watch(job, 0, false);
  client_.receive_event_until(
      [](auto& event) { return event.queued().reason().starts_with("waits for memory"); });
  v1::Envelope close;
  close.mutable_close_view()->set_view_id(1);
  client_.send(close);
  for (bool finished = false; !finished;) {
    const auto message = client_.receive();
    ASSERT_TRUE(message);
    finished = message->job_event().has_finished();
  }
  client_.send(open_view(client_, scene('b')));
  client_.ping();
}

TEST_F(Memory, AViewWhosePlanDoesNotFitIsClosedWithTheNumbers) {
  client_.send(open_view(client_, "shown picture 4096 4096 16"));
  const auto event = client_.receive();
  ASSERT_TRUE(event && event->has_view_event());
  EXPECT_EQ(event->view_event().closed().reason().kind(), v1::Failed::SERVER);
  EXPECT_EQ(event->view_event().closed().reason().reason(),
            "the view takes about 449 MiB of memory, most of it for its picture, and jobs and "
            "views may have 256 MiB (--memory)");
  client_.send(open_view(client_, "shown picture 64 48 16"));
  const auto shown = client_.receive();
  ASSERT_TRUE(shown && shown->has_view_event());
  EXPECT_TRUE(shown->view_event().has_updated());
}

TEST_F(Memory, WhatNeverFitsFailsAndTheNextOneRuns) {
  const auto huge = submit("picture 8192 8192 256", v1::CPU);
  const auto small = submit("picture 64 48 16", v1::CPU);
  client_.watch(huge);
  const auto end = client_.receive_event_until([](auto& event) { return event.has_failed(); });
  EXPECT_EQ(end.failed().kind(), v1::Failed::SERVER);
  EXPECT_EQ(end.failed().reason(),
            "it takes about 1601 MiB of memory, and jobs may have 256 MiB (--memory)");
  client_.watch(small);
  client_.receive_event_until([](auto& event) { return event.has_finished(); });
  EXPECT_EQ(client_.info().worker(0).starts(), 1u);
}

}  // namespace metamer::service::test
