// What the system has too little of is waited for; no job is lost to it.

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "../daemon.h"

namespace metamer::service::test {

namespace {

/// While it lives, this process gets no new descriptor.
class NoDescriptors {
 public:
  NoDescriptors() {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const int next = ::dup(0);
    ::close(next);
    rlimit none = before_;
    none.rlim_cur = static_cast<rlim_t>(next);
    ::setrlimit(RLIMIT_NOFILE, &none);
  }
  ~NoDescriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  NoDescriptors(const NoDescriptors&) = delete;

 private:
  rlimit before_{};
};

}  // namespace

TEST(Shortage, WithoutDescriptorsNoWorkerStartsAndTheJobsWait) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const auto first = client.submit("gate 1 crash 2 once");
  const auto second = client.submit("picture 64 48 16");
  client.watch(first);
  for (int tiles = 0; tiles < 1;) tiles += client.receive_event().has_tile();
  {
    const NoDescriptors none;
    daemon.open_gate();
    while (client.info().worker(0).starts() < 5) {  // three in a row have failed by then
    }
    for (const auto job : {first, second}) {
      const v1::JobSummary summary = client.summary(job);
      EXPECT_EQ(summary.state(), v1::QUEUED) << summary.ShortDebugString();
      EXPECT_NE(summary.reason().find("Too many open files"), std::string::npos)
          << summary.ShortDebugString();
    }
  }
  for (const auto job : {first, second}) {
    client.watch(job);
    client.receive_event_until([](auto& event) { return event.has_finished(); });
    EXPECT_EQ(client.summary(job).reason(), "");
  }
}

}  // namespace metamer::service::test
