// A worker sees the assets of its job and of its views, and no others.

#include <gtest/gtest.h>
#include <poll.h>

#include <chrono>
#include <filesystem>
#include <fstream>

#include "../daemon.h"
#include "common/digest.h"

namespace metamer::service::test {

namespace {

namespace fs = std::filesystem;

class OwnAssets : public testing::Test {
 protected:
  OwnAssets() { client_.hello(); }

  fs::path store() const { return daemon_.folder() / "store"; }
  /// How many workers see the asset now.
  int seers(const std::string& asset) const {
    int count = 0;
    for (const auto& entry : fs::directory_iterator(store()))
      if (entry.path().filename().string().starts_with("worker-"))
        count += fs::exists(entry.path() / to_hex(sha256(asset)));
    return count;
  }
  /// Waits, but not for ever.
  bool come_to_be_seen_by(int workers, const std::string& asset) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (seers(asset) != workers) {
      if (std::chrono::steady_clock::now() > end) return false;
      ::poll(nullptr, 0, 5);
    }
    return true;
  }
  v1::Envelope open_view(const std::string& scene) {
    v1::Envelope message;
    message.mutable_open_view()->set_scene_sha256(client_.upload({scene})[0]);
    return message;
  }

  Daemon daemon_;
  Client client_{daemon_.socket()};
};

}  // namespace

TEST_F(OwnAssets, AreAllThatAWorkerReachesThatWasTakenOver) {
  const std::string secret = "somebody else's scene";
  Client other(daemon_.socket());
  other.hello();
  other.upload({secret});
  client_.watch(client_.submit("reach " + to_hex(sha256(secret))));
  const auto event = client_.receive_event_until([](auto& one) { return one.has_failed(); });
  if (event.failed().reason() == "unconfined")
    GTEST_SKIP() << "this kernel has no Landlock or no seccomp";
  EXPECT_EQ(event.failed().reason(), "own;");
  std::ifstream file(store() / to_hex(sha256(secret)));
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(file), {}), secret);
}

TEST_F(OwnAssets, AreThoseOfTheJobWhileItRuns) {
  const std::string script = "gate 0", next = "gate 0 prepared 1000";
  const auto job = client_.submit(script), waiting = client_.submit(next);
  client_.watch(job);
  client_.receive_event_until([](auto& event) { return event.has_planned(); });
  EXPECT_EQ(seers(script), 1);
  EXPECT_EQ(seers(next), 0) << "it waits";
  daemon_.open_gate();
  client_.receive_event_until([](auto& event) { return event.has_finished(); });
  client_.watch(waiting);
  client_.receive_event_until([](auto& event) { return event.has_planned(); });
  EXPECT_EQ(seers(script), 0) << "it has left the worker";
  EXPECT_EQ(seers(next), 1);
  daemon_.open_gate();
  client_.receive_event_until([](auto& event) { return event.has_finished(); });
  EXPECT_TRUE(come_to_be_seen_by(0, next));
}

TEST_F(OwnAssets, AreThoseOfViewsUntilTheyAreClosed) {
  const std::string scene = "a scene", shared = "one that two look at";
  client_.send(open_view(scene));
  client_.send(open_view(shared));
  {
    Client other(daemon_.socket());
    other.hello();
    v1::Envelope message = open_view(shared);
    other.send(message);
    other.ping();
    ASSERT_TRUE(come_to_be_seen_by(1, scene));
    ASSERT_TRUE(come_to_be_seen_by(1, shared));
  }
  client_.ping();
  v1::Envelope close;
  close.mutable_close_view()->set_view_id(1);
  client_.send(close);
  ASSERT_TRUE(come_to_be_seen_by(0, scene));
  EXPECT_EQ(seers(shared), 1);
}

TEST_F(OwnAssets, AreNotLeftBehindByADaemonThatWasKilled) {
  const fs::path other = daemon_.folder() / "other", left = other / "worker-abc123";
  fs::create_directories(left);
  std::ofstream(left / "asset") << "bytes";
  ASSERT_TRUE(AssetStore::open(other, 1000));
  EXPECT_FALSE(fs::exists(left));
}

TEST_F(OwnAssets, AFileThatCannotBeLinkedIsAnErrorThatNamesIt) {
  const auto store = AssetStore::open(daemon_.folder() / "other", 1000).value();
  const std::string bytes = "bytes";
  auto upload = AssetUpload::begin(*store, {}, sha256(bytes), bytes.size()).value();
  ASSERT_TRUE(upload.add(0, bytes) && upload.commit());
  AssetHolds holds(*store);
  ASSERT_TRUE(holds.add(sha256(bytes)));
  const auto folder = AssetFolder::make(store->folder()).value();
  fs::remove(store->file(sha256(bytes)));
  const auto shown = folder->show({&holds});
  ASSERT_FALSE(shown);
  EXPECT_EQ(shown.error().message,
            "can't link " + store->file(sha256(bytes)).string() + ": No such file or directory");
}

}  // namespace metamer::service::test
