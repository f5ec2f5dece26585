// Ended jobs go with their files when their time is over, and nothing else does.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <set>
#include <thread>

#include "../daemon.h"
#include "../temporary_state.h"
#include "common/digest.h"

namespace metamer::service::test {
namespace {

constexpr double day = 86400;

/// A daemon whose clock the test moves.
class KeptForDays : public testing::Test {
 protected:
  TemporaryState state_;
  std::atomic<double> ahead_ = 0;
  std::unique_ptr<Daemon> daemon_;
  std::unique_ptr<Client> client_;

  void start() {
    end();
    daemon_ = std::make_unique<Daemon>([this](ServiceOptions& options) {
      options.state = state_.path();
      options.store.clear();
      options.limits.keep_days = 3;
      options.clock = [this] { return wall_clock() + ahead_; };
    });
    client_ = std::make_unique<Client>(daemon_->socket());
    client_->hello();
  }
  void end() {
    client_.reset();
    daemon_.reset();
  }
  std::uint64_t finished(const std::string& scene) {
    const std::uint64_t job = client_->submit(scene);
    client_->watch(job, 0, false);
    client_->receive_event_until([](const v1::JobEvent& event) { return event.has_finished(); });
    return job;
  }
  std::set<std::uint64_t> listed() {
    v1::Envelope message;
    message.mutable_list_jobs();
    std::set<std::uint64_t> jobs;
    const v1::Envelope answer = client_->ask(message);
    for (const v1::JobSummary& job : answer.job_list().job()) jobs.insert(job.job_id());
    return jobs;
  }
  /// Whether it comes true within 20 s.
  bool comes(const std::function<bool()>& holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (!holds()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return true;
  }
  std::set<std::string> tile_files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(state_.path() / "jobs"))
      names.insert(entry.path().filename().string());
    return names;
  }
  static std::string tiles_of(std::uint64_t job) { return std::to_string(job) + ".tiles"; }
  bool has_asset(const std::string& text) {
    v1::Envelope offer;
    offer.mutable_offer_assets()->add_sha256(std::string(to_bytes(sha256(text))));
    return client_->ask(offer).missing_assets().sha256_size() == 0;
  }
};

TEST_F(KeptForDays, AnEndedOneGoesWithItsFileAndOneThatHasNotEndedStays) {
  start();
  const std::string scene = "picture 64 64 16 gate 5";
  const std::uint64_t old = finished("picture 8 8 8");
  const std::uint64_t live = client_->submit(scene);
  client_->watch(live);
  int tiles = 0;
  client_->receive_event_until(
      [&](const v1::JobEvent& event) { return event.has_tile() && ++tiles == 5; });
  // Tiles are told of before they are written.
  ASSERT_TRUE(comes([&] { return tile_files() == std::set{tiles_of(old), tiles_of(live)}; }));

  ahead_ = 2.9 * day;
  const std::uint64_t later = client_->submit("picture 8 8 8");
  EXPECT_EQ(listed(), (std::set{old, live, later}));
  ahead_ = 3.1 * day;
  ASSERT_TRUE(comes([&] { return listed() == std::set{live, later}; }));
  ASSERT_TRUE(comes([&] { return !tile_files().contains(tiles_of(old)); }));
  EXPECT_TRUE(has_asset(scene)) << "a job that goes takes nothing that another one names";
  daemon_->open_gate();
  client_->receive_event_until([](const v1::JobEvent& event) { return event.has_finished(); });
}

TEST_F(KeptForDays, OneWhoseTimeIsOverWhileNoDaemonRunsGoesAtTheNextStart) {
  start();
  const std::uint64_t old = finished("picture 8 8 8");
  end();
  ahead_ = 4 * day;
  start();
  ASSERT_TRUE(comes([&] { return listed().empty() && tile_files().empty(); }));
  ahead_ = 0;
  start();
  EXPECT_GT(client_->submit("picture 8 8 8"), old);
}

TEST_F(KeptForDays, FilesWithoutAJobAreRemovedAtTheStart) {
  start();
  const std::uint64_t job = finished("picture 8 8 8");
  end();
  std::ofstream(state_.path() / "jobs" / "4711.tiles") << "left behind by a crash";
  start();
  EXPECT_EQ(tile_files(), std::set{tiles_of(job)});
}

}  // namespace
}  // namespace metamer::service::test
