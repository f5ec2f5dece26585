#include "server/worker/link.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "common/wire/blocking.h"

namespace metamer::worker {
namespace {

v1::WorkerEnvelope numbered(std::uint64_t number) {
  v1::WorkerEnvelope message;
  message.set_job_id(number);
  message.mutable_stopped();
  return message;
}

class WorkerLink : public testing::Test {
 protected:
  WorkerLink() { EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends_.data()), 0); }
  ~WorkerLink() override {
    ::close(ends_[0]);
    ::close(ends_[1]);
  }
  /// Whether the daemon's end has something to read.
  bool has_come() const {
    pollfd end{.fd = ends_[1], .events = POLLIN, .revents = 0};
    return ::poll(&end, 1, 0) == 1;
  }
  std::uint64_t next() {
    const auto message = wire::read_envelope(ends_[1]);
    return message && *message ? (*message)->job_id() : 0;
  }

  std::array<int, 2> ends_{};
};

TEST_F(WorkerLink, SendsWhatStandsAloneAtOnce) {
  Link link(ends_[0]);
  EXPECT_TRUE(link.send_with_others(numbered(1)));
  EXPECT_TRUE(has_come());
  EXPECT_EQ(next(), 1u);
}

TEST_F(WorkerLink, KeepsTheOrderAndLosesNothing) {
  Link link(ends_[0]);
  EXPECT_TRUE(link.send(numbered(1)));
  for (std::uint64_t i = 2; i < 100; ++i) EXPECT_TRUE(link.send_with_others(numbered(i)));
  EXPECT_TRUE(link.send(numbered(100)));
  for (std::uint64_t i = 1; i <= 100; ++i) EXPECT_EQ(next(), i);
  EXPECT_FALSE(has_come());
}

TEST_F(WorkerLink, KeepsSwarmsNoLongerThanItSays) {
  Link link(ends_[0]);
  EXPECT_TRUE(link.send_with_others(numbered(1)));
  EXPECT_TRUE(link.send_with_others(numbered(2)));
  std::this_thread::sleep_for(Link::lateness);
  EXPECT_TRUE(link.send_with_others(numbered(3)));
  for (std::uint64_t i = 1; i <= 3; ++i) EXPECT_EQ(next(), i);
}

TEST_F(WorkerLink, SaysThatTheDaemonIsGone) {
  Link link(ends_[0]);
  ::shutdown(ends_[1], SHUT_RDWR);
  EXPECT_FALSE(link.send(numbered(1)));
}

}  // namespace
}  // namespace metamer::worker
