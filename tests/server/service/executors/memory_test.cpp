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
