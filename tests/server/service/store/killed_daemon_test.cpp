// The daemon is killed at any moment while clients submit, watch and cancel; what it has
// acknowledged is there afterwards.
#include <gtest/gtest.h>
#include <signal.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <random>
#include <set>
#include <thread>

#include "../client.h"
#include "../program.h"
#include "../temporary_state.h"
#include "server/service/store/database.h"

namespace metamer::service::test {
namespace {

constexpr int submitters = 8;

struct Acknowledged {
  std::uint64_t id = 0;
  unsigned width = 0, height = 0;
  bool cancelled = false;
};

/// One user of the daemon, who comes again whenever it is gone.
class Submitter {
 public:
  Submitter(std::string socket, unsigned seed) : socket_(std::move(socket)), random_(seed) {}

  void run(const std::atomic<bool>& stop) {
    while (!stop) submit_one(stop);
  }
  /// After its end.
  const std::vector<Acknowledged>& acknowledged() const { return acknowledged_; }
  /// How many they are, at any time.
  std::size_t count() const { return count_; }

 private:
  unsigned draw(unsigned below) { return static_cast<unsigned>(random_() % below); }

  /// Repeats `talk` on new connections until it has gone through.
  bool insist(const std::atomic<bool>& stop, const std::function<void(Client&)>& talk) {
    while (!stop) {
      try {
        Client client(socket_);
        client.hello();
        talk(client);
        return true;
      } catch (const std::runtime_error&) {
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    }
    return false;
  }

  void submit_one(const std::atomic<bool>& stop) {
    Acknowledged job{.id = 0, .width = 8 + draw(57), .height = 8 + draw(57), .cancelled = false};
    std::string key;
    for (int i = 0; i < 16; ++i) key += static_cast<char>(draw(256));
    const bool submitted = insist(stop, [&](Client& client) {
      v1::Envelope message;
      v1::Submit& submit = *message.mutable_submit();
      submit.set_client_key(key);
      submit.set_scene_sha256(client.upload(
          {"picture " + std::to_string(job.width) + " " + std::to_string(job.height) + " 8"})[0]);
      const v1::Envelope answer = client.ask(message);
      if (!answer.has_submitted()) throw std::runtime_error(answer.ShortDebugString());
      job.id = answer.submitted().job_id();
    });
    if (!submitted) return;
    if (draw(6) == 0) cancel(stop, job);
    acknowledged_.push_back(job);
    ++count_;
    std::this_thread::sleep_for(std::chrono::milliseconds(draw(20)));
  }

  void cancel(const std::atomic<bool>& stop, Acknowledged& job) {
    insist(stop, [&](Client& client) {
      v1::Envelope message;
      message.mutable_cancel()->set_job_id(job.id);
      const v1::Envelope answer = client.ask(message);
      // Ended before; or cancelled by an answer that got lost, which is found out at the end.
      job.cancelled = answer.job_summary().state() == v1::CANCELLED;
    });
  }

  std::string socket_;
  std::mt19937 random_;
  std::vector<Acknowledged> acknowledged_;
  std::atomic<std::size_t> count_ = 0;
};

struct KilledDaemon : testing::Test {
  TemporaryState state, place;
  std::string socket = (place.path() / "socket").string();

  std::unique_ptr<Program> start() {
    auto daemon = std::make_unique<Program>(
        place.path(), std::vector<std::string>{"--listen", "unix:" + socket, "--parent-fd", "3",
                                               "--state", state.path().string(), "--live-jobs",
                                               "4000", "--ended-jobs", "100000"});
    EXPECT_EQ(daemon->ready(), "ready\n") << daemon->log();
    return daemon;
  }

  std::map<std::uint64_t, v1::JobSummary> jobs(Client& client) {
    std::map<std::uint64_t, v1::JobSummary> all;
    v1::Envelope message;
    message.mutable_list_jobs();
    for (bool more = true; more;) {
      const v1::Envelope answer = client.ask(message);
      for (const v1::JobSummary& job : answer.job_list().job()) {
        EXPECT_FALSE(all.contains(job.job_id()));
        all[job.job_id()] = job;
        message.mutable_list_jobs()->set_after(job.job_id());
      }
      more = answer.job_list().more();
    }
    return all;
  }

  /// Each pixel is as the fake worker makes it: (x, y, 1).
  void expect_picture(Client& client, const Acknowledged& job) {
    client.watch(job.id);
    std::set<std::pair<unsigned, unsigned>> pixels;
    std::uint32_t recorded = 0;
    client.receive_event_until([&](const v1::JobEvent& event) {
      for (const v1::MachineRecord& machine : event.finished().record().machine())
        recorded += machine.tiles();
      if (event.has_retrying() && event.retrying().from_start()) pixels.clear();
      if (!event.has_tile()) return event.has_finished();
      const v1::Tile& tile = event.tile();
      const auto* xyz = reinterpret_cast<const float*>(tile.xyz().data());
      for (unsigned y = tile.y(); y < tile.y() + tile.height(); ++y)
        for (unsigned x = tile.x(); x < tile.x() + tile.width(); ++x, xyz += 3) {
          EXPECT_TRUE(pixels.insert({x, y}).second) << "a tile came twice";
          EXPECT_EQ(xyz[0], static_cast<float>(x));
          EXPECT_EQ(xyz[1], static_cast<float>(y));
          EXPECT_EQ(xyz[2], 1.f);
        }
      return false;
    });
    EXPECT_EQ(pixels.size(), std::size_t{job.width} * job.height) << "of job " << job.id;
    EXPECT_EQ(recorded, (job.width + 7) / 8 * ((job.height + 7) / 8)) << "of job " << job.id;
  }

  /// Kills the daemon so many times, each at a moment between ready and `longest` later.
  void survive(int kills, int longest_ms, unsigned seed) {
    std::mt19937 random(seed);
    std::atomic<bool> stop = false;
    std::vector<std::unique_ptr<Submitter>> users;
    std::vector<std::jthread> threads;
    struct Stop {
      std::atomic<bool>& stop;
      ~Stop() { stop = true; }
    } const at_the_end{stop};  // before the threads are joined
    auto daemon = start();
    for (unsigned i = 0; i < submitters; ++i) {
      users.push_back(std::make_unique<Submitter>(socket, seed * 1000 + i));
      threads.emplace_back([&stop, user = users.back().get()] { user->run(stop); });
    }
    for (int kill = 0; kill < kills; ++kill) {
      const auto wait = random() % static_cast<unsigned>(longest_ms);
      std::this_thread::sleep_for(std::chrono::milliseconds(wait));
      daemon->signal(SIGKILL);
      EXPECT_EQ(daemon->wait(), -SIGKILL) << daemon->log();
      {
        Database database(state.database());
        EXPECT_EQ(database.damage(), std::nullopt) << "after kill " << kill;
      }
      daemon = start();
    }
    // On a busy machine few came through between two kills.
    const auto count_all = [&users] {
      std::size_t sum = 0;
      for (const auto& user : users) sum += user->count();
      return sum;
    };
    while (count_all() <= static_cast<std::size_t>(kills))
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    stop = true;
    for (std::jthread& thread : threads) thread.join();

    Client client(socket);
    client.hello();
    std::size_t count = 0;
    std::set<std::uint64_t> ids;
    for (const auto& user : users)
      for (const Acknowledged& job : user->acknowledged()) {
        ++count;
        EXPECT_TRUE(ids.insert(job.id).second) << "job " << job.id << " is two";
      }
    // What was asked for when the end came may be there unacknowledged: one of each user.
    const auto listed = jobs(client);
    EXPECT_LE(listed.size(), count + submitters);
    for (const auto& user : users)
      for (const Acknowledged& job : user->acknowledged()) {
        ASSERT_TRUE(listed.contains(job.id)) << "job " << job.id << " is lost";
        const v1::JobState known = listed.at(job.id).state();
        EXPECT_NE(known, v1::FAILED) << listed.at(job.id).reason();
        EXPECT_TRUE(!job.cancelled || known == v1::CANCELLED);
        if (known != v1::CANCELLED) expect_picture(client, job);
      }
    std::cout << kills << " kills, " << count << " jobs\n";
  }
};

TEST_F(KilledDaemon, LosesNoJobThatItAcknowledged) { survive(10, 200, 1); }

struct LongKilledDaemon : KilledDaemon {};
TEST_F(LongKilledDaemon, LosesNoJobThatItAcknowledgedIn200Deaths) { survive(200, 400, 2); }

}  // namespace
}  // namespace metamer::service::test
