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
  while (!client->info().trouble().empty())
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  kill();
  start();
  EXPECT_EQ(client->summary(job).state(), v1::FINISHED);
  expect_whole(job);
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
