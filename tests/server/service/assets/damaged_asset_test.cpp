// Files of the store that were changed or removed while the daemon runs.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "../daemon.h"
#include "common/digest.h"

namespace metamer::service::test {

namespace {

namespace fs = std::filesystem;

const std::string script = "picture 8 8 8";

/// The same size and, as far as a program can set it, the same time.
void flip_a_byte(const fs::path& file) {
  const auto time = fs::last_write_time(file);
  std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(8).put('9');
  fs::last_write_time(file, time);
}

void remove(const fs::path& file) { fs::remove(file); }

struct Damage {
  const char* name;
  void (*spoil)(const fs::path&);
  bool is_seen = false;  ///< Without reading: by its size.
};

void PrintTo(const Damage& damage, std::ostream* stream) { *stream << damage.name; }

template <class Test>
class DamagedAssetTest : public Test {
 protected:
  Daemon daemon_;
  Client client_{daemon_.socket()};

  fs::path file() const { return daemon_.folder() / "store" / to_hex(sha256(script)); }
  v1::Envelope submit() {
    v1::Envelope message;
    message.mutable_submit()->set_scene_sha256(std::string(to_bytes(sha256(script))));
    return client_.ask(message);
  }
  v1::Envelope offer() {
    v1::Envelope message;
    message.mutable_offer_assets()->add_sha256(std::string(to_bytes(sha256(script))));
    return client_.ask(message);
  }
  void SetUp() override {
    client_.hello();
    client_.upload({script});
  }
};
using DamagedAsset = DamagedAssetTest<testing::TestWithParam<Damage>>;
using DamagedAssetAlone = DamagedAssetTest<testing::Test>;

}  // namespace

TEST_P(DamagedAsset, IsRefusedByNameAndTakenAnew) {
  ASSERT_TRUE(submit().has_submitted());
  GetParam().spoil(file());
  const v1::Envelope refused = submit();
  ASSERT_TRUE(refused.has_error()) << refused.ShortDebugString();
  EXPECT_EQ(refused.error().code(), v1::Error::MISSING_ASSET);
  EXPECT_EQ(refused.error().message(),
            "the server's file of the scene is damaged: " + file().string() + "; send it again");
  EXPECT_EQ(offer().missing_assets().sha256_size(), 1);
  client_.upload({script});
  std::ifstream stored(file());
  EXPECT_EQ(std::string(std::istreambuf_iterator<char>(stored), {}), script);
  EXPECT_EQ(offer().missing_assets().sha256_size(), 0);
  EXPECT_TRUE(submit().has_submitted());
}

TEST_P(DamagedAsset, IsMissingWhenItIsOfferedFirst) {
  GetParam().spoil(file());
  EXPECT_EQ(offer().missing_assets().sha256_size(), 1);
}

TEST_P(DamagedAsset, FailsTheJobThatWaitedMeanwhile) {
  const auto gate = client_.submit("gate 0");
  const auto job = submit().submitted().job_id();
  client_.watch(gate);
  client_.receive_event_until([](auto& event) { return event.has_planned(); });
  GetParam().spoil(file());
  daemon_.open_gate();
  client_.watch(job);
  v1::JobEvent event;
  do event = client_.receive_event();
  while (event.job_id() != job || !(event.has_failed() || event.has_finished()));
  ASSERT_TRUE(event.has_failed()) << event.ShortDebugString();
  EXPECT_EQ(event.failed().kind(), v1::Failed::SERVER);
  if (GetParam().is_seen)
    EXPECT_EQ(event.failed().reason(),
              "the server's file of the scene is damaged: " + file().string() + "; send it again");
  else
    EXPECT_EQ(event.failed().reason(), "a worker read other bytes");
  EXPECT_EQ(offer().missing_assets().sha256_size(), 1);
}

TEST_F(DamagedAssetAlone, IsNotWhatAWorkerAloneSays) {
  client_.watch(client_.submit("slander"));
  EXPECT_TRUE(
      client_.receive_event_until([](auto& event) { return event.has_failed(); }).has_failed());
  v1::Envelope offer;
  offer.mutable_offer_assets()->add_sha256(std::string(to_bytes(sha256("slander"))));
  EXPECT_EQ(client_.ask(offer).missing_assets().sha256_size(), 0);
}

INSTANTIATE_TEST_SUITE_P(That, DamagedAsset,
                         testing::Values(Damage{"was_changed", flip_a_byte},
                                         Damage{"was_removed", remove, true}),
                         [](const auto& damage) { return damage.param.name; });

}  // namespace metamer::service::test
