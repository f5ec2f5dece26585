// A disk that is full for a while, and one that breaks.
#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <fstream>
#include <thread>

#include "../client.h"
#include "../gate.h"
#include "../program.h"
#include "../temporary_state.h"
#include "common/digest.h"

namespace metamer::service::test {
namespace {

struct FailingDisk : testing::Test {
  TemporaryState state, place;
  Gate gate{state.path()};
  std::string socket = (place.path() / "socket").string();
  std::filesystem::path full = place.path() / "full", broken = place.path() / "broken";
  std::unique_ptr<Program> daemon;
  std::unique_ptr<Client> client;

  void start() {
    daemon = std::make_unique<Program>(
        place.path(),
        std::vector<std::string>{"--listen", "unix:" + socket, "--parent-fd", "3", "--state",
                                 state.path().string()},
        std::vector<std::string>{
            "LD_PRELOAD=" METAMER_BIN "/forgetful-disk.so", "METAMER_DISK=" + state.path().string(),
            "METAMER_DISK_FULL=" + full.string(), "METAMER_DISK_BROKEN=" + broken.string()});
    ASSERT_EQ(daemon->ready(), "ready\n") << daemon->log();
    client = std::make_unique<Client>(socket);
    client->hello();
  }
  void kill() {
    client.reset();
    daemon->signal(SIGKILL);
    daemon->wait();
  }
  static void begin(const std::filesystem::path& trouble) { std::ofstream(trouble).put('x'); }
  /// It is full until so many files with something in them were removed.
  void fill(int removals) { std::ofstream(full) << removals; }
  void wait_until_healthy() {
    while (!client->info().trouble().empty())
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  std::size_t count_in_log(const std::string& text) const {
    const std::string log = daemon->log();
    std::size_t count = 0;
    for (auto at = log.find(text); at != std::string::npos; at = log.find(text, at + 1)) ++count;
    return count;
  }
  /// `metamerd user …` on this disk: its exit code.
  int user(const std::string& words) const {
    const std::string line =
        "LD_PRELOAD=" METAMER_BIN "/forgetful-disk.so METAMER_DISK=" + state.path().string() +
        " METAMER_DISK_FULL=" + full.string() +
        " ASAN_OPTIONS=verify_asan_link_order=0 " METAMER_BIN "/metamerd user " + words +
        " --state " + state.path().string() + " >" + (place.path() / "said").string() + " 2>&1";
    return WEXITSTATUS(std::system(line.c_str()));
  }
  std::string said() const {
    std::ifstream file(place.path() / "said");
    return {std::istreambuf_iterator<char>(file), {}};
  }
  static void end(const std::filesystem::path& trouble) { std::filesystem::remove(trouble); }

  /// A job whose worker waits at its gate with three of its twelve tiles done.
  std::uint64_t job_at_the_gate() {
    const std::uint64_t job = client->submit("picture 64 48 16 gate 3");
    client->watch(job);
    int tiles = 0;
    client->receive_event_until(
        [&](const v1::JobEvent& event) { return event.has_tile() && ++tiles == 3; });
    return job;
  }
  void receive_the_rest() {
    int tiles = 3;
    client->receive_event_until([&](const v1::JobEvent& event) {
      tiles += event.has_tile();
      return event.has_finished();
    });
    EXPECT_EQ(tiles, 12);
  }
  void expect_whole(std::uint64_t job) {
    client->watch(job);
    std::set<std::pair<unsigned, unsigned>> tiles;
    client->receive_event_until([&](const v1::JobEvent& event) {
      if (event.has_tile()) tiles.insert({event.tile().x(), event.tile().y()});
      return event.has_finished();
    });
    EXPECT_EQ(tiles.size(), 12u);
  }
  static std::string digest_of(const std::string& asset) {
    return std::string(to_bytes(sha256(asset)));
  }
  bool stores(const std::string& asset) {
    v1::Envelope message;
    message.mutable_offer_assets()->add_sha256(digest_of(asset));
    return client->ask(message).missing_assets().sha256_size() == 0;
  }
  v1::Envelope try_upload(const std::string& asset) {
    v1::Envelope message;
    v1::AssetChunk& chunk = *message.mutable_asset_chunk();
    chunk.set_sha256(digest_of(asset));
    chunk.set_size(asset.size());
    chunk.set_data(asset);
    return client->ask(message);
  }
  /// Another, which holds none of the one's assets.
  void come_again() {
    client = std::make_unique<Client>(socket);
    client->hello();
  }
  v1::Envelope submit(const std::string& asset) {
    v1::Envelope message;
    message.mutable_submit()->set_scene_sha256(asset);
    return client->ask(message);
  }
};

TEST_F(FailingDisk, ThatIsFullRefusesJobsUntilThereIsRoom) {
  start();
  const std::string asset = client->upload({"picture 64 48 16"})[0];
  begin(full);
  const v1::Envelope answer = submit(asset);
  EXPECT_EQ(answer.error().code(), v1::Error::INTERNAL);
  EXPECT_NE(answer.error().message().find("full"), std::string::npos) << answer.error().message();
  EXPECT_NE(client->info().trouble(), "");
  client->ping();
  end(full);
  const std::uint64_t job = submit(asset).submitted().job_id();
  expect_whole(job);
  kill();
  start();
  expect_whole(job);
}

TEST_F(FailingDisk, ThatIsFullCostsNoPictureThatIsUnderWay) {
  start();
  const std::uint64_t job = job_at_the_gate();
  begin(full);
  gate.open();
  receive_the_rest();
  // It can't be kept, and is not said to be.
  kill();
  end(full);
  start();
  gate.open();
  expect_whole(job);
}

TEST_F(FailingDisk, ThatHasRoomAgainGetsWhatItCouldNotTake) {
  start();
  const std::uint64_t job = job_at_the_gate();
  begin(full);
  gate.open();
  receive_the_rest();
  end(full);
  wait_until_healthy();
  kill();
  start();
  EXPECT_EQ(client->summary(job).state(), v1::FINISHED);
  expect_whole(job);
}

TEST_F(FailingDisk, ThatIsFullLosesAssetsThatNobodyHoldsBeforeAnUploadIsRefused) {
  start();
  client->upload({"first", "second"});
  come_again();
  client->upload({"held"});
  fill(2);
  const std::string asset = client->upload({"picture 64 48 16"})[0];
  EXPECT_EQ(client->info().trouble(), "");
  EXPECT_NE(submit(asset).submitted().job_id(), 0u);
  EXPECT_TRUE(stores("held"));
  EXPECT_FALSE(stores("first"));
  EXPECT_FALSE(stores("second"));
}

TEST_F(FailingDisk, ThatIsFullLosesAssetsThatNobodyHoldsBeforeATileOrAJobIsRefused) {
  start();
  client->upload({"first"});
  come_again();
  const std::uint64_t job = job_at_the_gate();
  fill(1);
  gate.open();
  receive_the_rest();
  kill();
  start();
  EXPECT_EQ(client->summary(job).state(), v1::FINISHED);
  expect_whole(job);
  client->upload({"second"});
  come_again();
  const std::string asset = client->upload({"picture 8 8 8"})[0];
  fill(1);
  EXPECT_NE(submit(asset).submitted().job_id(), 0u);
}

TEST_F(FailingDisk, ThatIsFullCostsNoPictureThatCanBeFetched) {
  start();
  const std::uint64_t job = client->submit("picture 64 48 16");
  expect_whole(job);
  begin(full);
  const v1::Envelope answer = try_upload("another");
  EXPECT_EQ(answer.error().code(), v1::Error::INTERNAL);
  expect_whole(job);
  EXPECT_EQ(client->summary(job).state(), v1::FINISHED);
}

TEST_F(FailingDisk, ThatRefusedAnUploadIsATroubleUntilItTakesSomething) {
  start();
  begin(full);
  EXPECT_EQ(try_upload("another").error().code(), v1::Error::INTERNAL);
  EXPECT_NE(client->info().trouble().find("the asset store can't be written"), std::string::npos)
      << client->info().trouble();
  end(full);
  wait_until_healthy();
  EXPECT_EQ(count_in_log("the asset store can't be written"), 1u);
  EXPECT_EQ(count_in_log("the asset store can be written again"), 1u);
}

TEST_F(FailingDisk, ThatIsFullForSecondsIsLoggedOnce) {
  start();
  job_at_the_gate();
  begin(full);
  gate.open();
  receive_the_rest();
  // It is tried again each second.
  std::this_thread::sleep_for(std::chrono::milliseconds(2500));
  end(full);
  wait_until_healthy();
  EXPECT_EQ(count_in_log("the tiles of jobs can't be written"), 1u) << daemon->log();
  EXPECT_EQ(count_in_log("the tiles of jobs can be written again"), 1u) << daemon->log();
}

TEST_F(FailingDisk, ThatIsFullLetsUsersBeListedAndRevoked) {
  start();
  kill();
  ASSERT_EQ(user("add ann --role submitter --uid 4000"), 0) << said();
  for (const bool runs : {true, false}) {
    if (runs) start();
    begin(full);
    EXPECT_EQ(user("list"), 0) << said();
    EXPECT_NE(said().find("ann: submitter"), std::string::npos) << said();
    EXPECT_EQ(user("add bea --role submitter"), 1);
    EXPECT_NE(said().find("make room on its disk first"), std::string::npos) << said();
    end(full);
    if (runs) kill();
  }
  start();
  kill();
  fill(1);  // what the daemon keeps for this
  EXPECT_EQ(user("revoke ann"), 0) << said();
  EXPECT_EQ(user("list"), 0);
  EXPECT_NE(said().find("ann: submitter, uid 4000, share 1, revoked"), std::string::npos) << said();
}

TEST_F(FailingDisk, ThatBreaksIsNotWrittenAnyMoreAndReadOn) {
  start();
  const std::uint64_t before = client->submit("picture 64 48 16");
  expect_whole(before);
  const std::string asset = client->upload({"picture 8 8 8"})[0];
  begin(broken);
  EXPECT_EQ(submit(asset).error().code(), v1::Error::INTERNAL);
  end(broken);
  EXPECT_EQ(submit(asset).error().code(), v1::Error::INTERNAL) << "nobody knows what is there";
  EXPECT_NE(client->info().trouble(), "");
  expect_whole(before);
  kill();
  start();
  expect_whole(before);
  EXPECT_NE(submit(asset).submitted().job_id(), 0u);
}

}  // namespace
}  // namespace metamer::service::test
