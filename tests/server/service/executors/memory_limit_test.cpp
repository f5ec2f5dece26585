// What a job may take of memory is what the system gives its worker, and no more.

#include "server/service/executors/memory_limit.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "../daemon.h"
#include "server/service/schedule/admission.h"

namespace metamer::service::test {

namespace {

constexpr std::uint64_t mebi = std::uint64_t{1} << 20;

rlimit limit_of(pid_t process) {
  rlimit limit{};
  EXPECT_EQ(::prlimit(process, RLIMIT_DATA, nullptr, &limit), 0);
  return limit;
}

/// The jobs' worker is limited; where this build's can't be, the test has nothing to say.
#define SKIP_UNLESS_LIMITED(client)                                 \
  if (const std::string said = (client).info().worker(0).sandbox(); \
      said.find("memory: limited") == std::string::npos)            \
  GTEST_SKIP() << said

/// A process that asks for 64 MiB whenever it is told.
class Swelling {
 public:
  Swelling() {
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends_), 0);
    pid_ = ::fork();
    if (pid_ != 0) return;
    for (char word = 0; ::read(ends_[1], &word, 1) == 1 && ::write(ends_[1], &word, 1) == 1;)
      if (word == 's')
        ::mmap(nullptr, 64 * mebi, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    ::_exit(0);
  }
  ~Swelling() {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, nullptr, 0);
    ::close(ends_[0]);
    ::close(ends_[1]);
  }
  Swelling(const Swelling&) = delete;
  pid_t pid() const { return pid_; }
  void swell() {
    // The second answer comes once the first word has been obeyed.
    for (char word : {'s', 'n'}) {
      EXPECT_EQ(::write(ends_[0], &word, 1), 1);
      EXPECT_EQ(::read(ends_[0], &word, 1), 1);
    }
  }

 private:
  int ends_[2];
  pid_t pid_ = -1;
};

class SwollenJob : public testing::Test {
 protected:
  Daemon daemon_{[](ServiceOptions& options) {
    options.worker.command.threads = 1;
    options.limits.memory = 8192 * mebi;
  }};
  Client client_{daemon_.socket()};
  void SetUp() override {
    client_.hello();
    SKIP_UNLESS_LIMITED(client_);
  }
  v1::JobEvent end_of(std::uint64_t job) {
    client_.watch(job);
    retries_ = 0;
    return client_.receive_event_until([&](auto& event) {
      retries_ += event.has_retrying();
      return event.job_id() == job && (event.has_failed() || event.has_finished());
    });
  }
  int retries_ = 0;  // of the job whose end was last waited for
};

}  // namespace

TEST(MemoryLimit, IsAboveWhatTheWorkerHadAndCanBeRaisedAgain) {
  const Swelling worker;
  const std::uint64_t had = data_bytes(worker.pid());
  ASSERT_GT(had, 0u);
  MemoryLimit limit(worker.pid());
  if (limit.describe() != "limited for each job") GTEST_SKIP() << limit.describe();
  const rlim_t hard = limit_of(worker.pid()).rlim_max;
  limit.allow(100 * mebi);
  EXPECT_EQ(limit_of(worker.pid()).rlim_cur, had + 100 * mebi);
  limit.allow(200 * mebi);
  EXPECT_EQ(limit_of(worker.pid()).rlim_cur, had + 200 * mebi);
  limit.allow(~std::uint64_t{0});
  EXPECT_EQ(limit_of(worker.pid()).rlim_cur, hard);
  EXPECT_EQ(limit_of(worker.pid()).rlim_max, hard);
}

TEST(MemoryLimit, CountsFromWhatEarlierJobsLeftButNotFromAnyAmountOfIt) {
  Swelling worker;
  const std::uint64_t had = data_bytes(worker.pid());
  MemoryLimit limit(worker.pid());
  if (limit.describe() != "limited for each job") GTEST_SKIP() << limit.describe();
  worker.swell();
  limit.allow(10 * mebi);
  EXPECT_EQ(limit_of(worker.pid()).rlim_cur, had + 10 * mebi);
  limit.begin(1000 * mebi);
  limit.allow(10 * mebi);
  EXPECT_EQ(limit_of(worker.pid()).rlim_cur, had + 74 * mebi);
  limit.begin(5 * mebi);
  limit.allow(10 * mebi);
  EXPECT_EQ(limit_of(worker.pid()).rlim_cur, had + 15 * mebi);
}

TEST(MemoryLimit, OfAProcessThatIsGoneIsNone) {
  MemoryLimit limit(0x3fffffff);
  limit.allow(100 * mebi);
  EXPECT_EQ(limit.describe(), "not limited: /proc does not say what it has");
}

TEST_F(SwollenJob, FailsAtOnceAndSaysWhatWasEstimatedAndAllowed) {
  const auto job = client_.submit("picture 64 48 16 swell 2");
  const v1::JobEvent end = end_of(job);
  ASSERT_TRUE(end.has_failed());
  EXPECT_EQ(end.failed().kind(), v1::Failed::SERVER);
  EXPECT_EQ(end.failed().reason(),
            "needs more memory than it may take: about 65 MiB were estimated, 393 MiB are allowed, "
            "and not enough to render it");
  EXPECT_EQ(retries_, 0);
  EXPECT_EQ(client_.info().worker(0).last_exit(), "ran out of memory");
}

TEST_F(SwollenJob, CostsTheNextJobNothing) {
  const auto swollen = client_.submit("picture 64 48 16 swell 1");
  const auto next = client_.submit("picture 64 48 16");
  EXPECT_TRUE(end_of(swollen).has_failed());
  EXPECT_TRUE(end_of(next).has_finished());
}

TEST_F(SwollenJob, GetsASecondWorkerWhereTheFirstHadOtherJobs) {
  EXPECT_TRUE(end_of(client_.submit("picture 64 48 16")).has_finished());
  const auto job = client_.submit("picture 64 48 16 swell 0");
  const v1::JobEvent end = end_of(job);
  ASSERT_TRUE(end.has_failed());
  EXPECT_EQ(end.failed().kind(), v1::Failed::SERVER);
  EXPECT_EQ(retries_, 1);
}

TEST_F(SwollenJob, IsNotOneThatWasPlannedToBeLarge) {
  const auto job = client_.submit("picture 2048 2048 256 gate 1");
  client_.watch(job);
  client_.receive_event_until([](auto& event) { return event.has_tile(); });
  const auto worker = static_cast<pid_t>(client_.info().worker(0).pid());
  const rlim_t during = limit_of(worker).rlim_cur;
  EXPECT_GT(during, 2 * memory_estimate({.pixels = 2048 * 2048}));
  EXPECT_LT(during, 8192 * mebi);
  daemon_.open_gate();
  client_.receive_event_until([](auto& event) { return event.has_finished(); });
  // The worker has all that jobs may take again, and the next job its own.
  EXPECT_TRUE(end_of(client_.submit("picture 64 48 16")).has_finished());
  EXPECT_GT(limit_of(worker).rlim_cur, 8192 * mebi);
}

}  // namespace metamer::service::test
