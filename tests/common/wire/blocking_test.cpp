#include "common/wire/blocking.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "common/wire/frame.h"

namespace metamer::wire {

namespace {

class Blocking : public testing::Test {
 protected:
  int pair_[2] = {-1, -1};
  void SetUp() override { ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, pair_), 0); }
  void TearDown() override {
    for (const int fd : pair_) ::close(fd);
  }
  void put(const std::string& bytes) {
    ASSERT_EQ(::write(pair_[0], bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  void end() { ::shutdown(pair_[0], SHUT_WR); }
};

}  // namespace

TEST_F(Blocking, AFrameFarBeyondTheSocketsBufferArrives) {
  const std::string large(max_frame, 'x');
  std::thread writer([&] { EXPECT_TRUE(write_frame(pair_[0], large)); });
  EXPECT_EQ(read_frame(pair_[1]).value(), large);
  writer.join();
}

TEST_F(Blocking, OneFrameIsReadAndTheNextIsLeftAlone) {
  put(encode_frame("one") + encode_frame("two"));
  EXPECT_EQ(read_frame(pair_[1]).value(), "one");
  char rest[16];
  EXPECT_EQ(::recv(pair_[1], rest, sizeof rest, MSG_PEEK), 7);
  EXPECT_EQ(read_frame(pair_[1]).value(), "two");
}

TEST_F(Blocking, AnEndBetweenFramesIsNoErrorAndOneInsideIs) {
  put(encode_frame("one") + std::string("\0\0\0\5ab", 6));
  end();
  EXPECT_EQ(read_frame(pair_[1]).value(), "one");
  EXPECT_EQ(read_frame(pair_[1]).error().message, "the peer closed the connection in mid-frame");
  EXPECT_EQ(read_frame(pair_[1]).value(), std::nullopt);
}

TEST_F(Blocking, AFrameOf4GiBIsAnError) {
  put("\xFF\xFF\xFF\xFF");
  EXPECT_EQ(read_frame(pair_[1]).error().message, "the frame's length is over the limit");
}

TEST_F(Blocking, APeerThatIsGoneIsAnErrorAndNoSignal) {
  ::close(pair_[1]);
  pair_[1] = -1;
  EXPECT_EQ(write_frame(pair_[0], "x").error().message, "can't write: Broken pipe");
}

TEST_F(Blocking, BytesThatAreNoMessageAreAnError) {
  put(encode_frame("\xFF\xFF\xFF"));
  EXPECT_EQ(read_envelope(pair_[1]).error().message, "the frame holds no WorkerEnvelope");
}

TEST_F(Blocking, MessagesArriveAsTheyWereSent) {
  v1::WorkerEnvelope message;
  message.set_job_id(7);
  message.mutable_heartbeat()->set_work(9);
  ASSERT_TRUE(write_envelope(pair_[0], message));
  const auto got = read_envelope(pair_[1]).value();
  EXPECT_EQ(got->heartbeat().work(), 9u);
  EXPECT_EQ(got->job_id(), 7u);
}

TEST_F(Blocking, SignalsInterruptNothing) {
  struct sigaction action {};
  action.sa_handler = [](int) {};  // and no SA_RESTART
  struct sigaction before {};
  ::sigaction(SIGUSR1, &action, &before);
  const std::string large(1 << 20, 'x');
  std::atomic<bool> read = false;
  std::thread reader([&] {
    EXPECT_EQ(read_frame(pair_[1]).value(), large);
    read = true;
  });
  const pthread_t handle = reader.native_handle();
  std::thread writer([&] { EXPECT_TRUE(write_frame(pair_[0], large)); });
  for (int i = 0; i < 1000 && !read; ++i) ::pthread_kill(handle, SIGUSR1);
  writer.join();
  reader.join();
  ::sigaction(SIGUSR1, &before, nullptr);
}

}  // namespace metamer::wire
