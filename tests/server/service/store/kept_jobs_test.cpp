// What a daemon finds of its jobs when it is started anew.
#include <gtest/gtest.h>

#include <fstream>

#include "../daemon.h"
#include "../temporary_state.h"
#include "server/service/store/database.h"
#include "server/service/store/record_row.h"

namespace metamer::service::test {
namespace {

struct KeptJobs : testing::Test {
  TemporaryState state;
  std::unique_ptr<Daemon> daemon;
  std::unique_ptr<Client> client;
  v1::Welcome welcome;

  void start(const std::function<void(ServiceOptions&)>& change = {}) {
    daemon = std::make_unique<Daemon>([&](ServiceOptions& options) {
      options.state = state.path();
      options.store.clear();
      if (change) change(options);
    });
    client = std::make_unique<Client>(daemon->socket());
    welcome = client->hello();
  }
  void end() {
    client.reset();
    daemon.reset();
  }
  void run(const char* sql) {
    Database database(state.database());
    database.run(sql);
  }
  void mark_running(std::uint64_t job) {
    Database database(state.database());
    Statement get = database.prepare("SELECT record FROM jobs WHERE id=?");
    ASSERT_TRUE(get.bind(1, static_cast<std::int64_t>(job)).step());
    auto record = decode_record(get.bytes(0));
    ASSERT_TRUE(record);
    get.reset();
    record->set_state(v1::RUNNING);
    Statement put = database.prepare("UPDATE jobs SET record=? WHERE id=?");
    put.bind_bytes(1, encode_record(*record)).bind(2, static_cast<std::int64_t>(job)).run();
  }
  /// The tiles of a whole watch, by their places.
  std::map<std::pair<unsigned, unsigned>, std::string> picture(std::uint64_t job,
                                                               bool factors = false) {
    std::map<std::pair<unsigned, unsigned>, std::string> tiles;
    client->watch(job, 0, true, false, factors);
    client->receive_event_until([&](const v1::JobEvent& event) {
      if (event.has_retrying() && event.retrying().from_start()) tiles.clear();
      if (event.has_tile())
        tiles[{event.tile().x(), event.tile().y()}] = event.tile().xyz() + event.tile().factors();
      return event.has_finished() || event.has_failed() || event.has_cancelled();
    });
    return tiles;
  }
  std::uint64_t finished(const std::string& script, bool factors = false) {
    const std::uint64_t job = client->submit(script, false, factors);
    client->watch(job, 0, false);
    client->receive_event_until([](const v1::JobEvent& event) { return event.has_finished(); });
    return job;
  }
};

TEST_F(KeptJobs, AFinishedOneIsThereToTheBit) {
  start();
  const std::uint64_t job = finished("picture 100 70 16 factors 9", true);
  const auto before = picture(job, true);
  EXPECT_EQ(before.size(), 7u * 5);
  const std::string id = welcome.server_id();
  EXPECT_EQ(id.size(), 16u);
  end();

  start();
  EXPECT_EQ(welcome.server_id(), id);
  EXPECT_EQ(client->summary(job).state(), v1::FINISHED);
  EXPECT_EQ(picture(job, true), before);
}

TEST_F(KeptJobs, NumbersNeverComeAgain) {
  start();
  std::uint64_t last = 0;
  for (int i = 0; i < 3; ++i) last = finished("picture 8 8 8");
  end();
  start([](ServiceOptions& options) { options.keep_bytes = 0; });
  EXPECT_GT(finished("picture 8 8 8"), last);
  const std::uint64_t newest = finished("picture 8 8 8");
  end();
  run("DELETE FROM jobs");
  start();
  EXPECT_GT(finished("picture 8 8 8"), newest);
}

TEST_F(KeptJobs, OneThatRanGoesOnWithTheTilesThatItHad) {
  start();
  const std::uint64_t job = client->submit("picture 64 64 16 gate 5");
  client->watch(job);
  std::set<std::uint64_t> numbers;
  int tiles = 0;
  client->receive_event_until([&](const v1::JobEvent& event) {
    numbers.insert(event.sequence());
    return event.has_tile() && ++tiles == 5;
  });
  end();

  start();
  daemon->open_gate();
  client->watch(job, *numbers.rbegin() + 1);
  int more = 0;
  bool retried_from_start = false;
  client->receive_event_until([&](const v1::JobEvent& event) {
    EXPECT_FALSE(numbers.contains(event.sequence())) << "a number came twice";
    more += event.has_tile();
    retried_from_start |= event.has_retrying() && event.retrying().from_start();
    return event.has_finished();
  });
  EXPECT_EQ(more, 11);
  EXPECT_FALSE(retried_from_start);
  EXPECT_EQ(picture(job).size(), 16u);
}

TEST_F(KeptJobs, OneThatEndsEveryDaemonFailsAtLast) {
  start();
  const std::uint64_t job = client->submit("picture 64 64 16 gate 0");
  client->watch(job);
  client->receive_event_until([](const v1::JobEvent& event) { return event.has_planned(); });
  end();
  // As a crash leaves it: the end above has set it aside.
  int deaths = 0;
  for (; deaths < 20; ++deaths) {
    mark_running(job);
    start();
    if (client->summary(job).state() == v1::FAILED) break;
    end();
  }
  EXPECT_EQ(deaths, 7);
  EXPECT_NE(client->summary(job).reason().find("the server ended 8 times"), std::string::npos);
  EXPECT_EQ(picture(finished("picture 16 16 8")).size(), 4u);
}

TEST_F(KeptJobs, TilesOfAnotherWorkersBuildAreVoid) {
  start();
  const std::uint64_t job = client->submit("picture 64 64 16 gate 5");
  client->watch(job);
  int tiles = 0;
  client->receive_event_until(
      [&](const v1::JobEvent& event) { return event.has_tile() && ++tiles == 5; });
  end();

  // The same program with another tail is another build.
  const auto program = state.path() / "metamer-fake-worker";
  std::filesystem::copy_file(METAMER_BIN "/metamer-fake-worker", program);
  std::ofstream(program, std::ios::app) << "newer";
  start([&](ServiceOptions& options) { options.worker.command.program = program; });
  daemon->open_gate();
  client->watch(job);
  bool anew = false;
  int since = 0;
  client->receive_event_until([&](const v1::JobEvent& event) {
    if (event.has_retrying() && event.retrying().from_start()) anew = true, since = 0;
    since += event.has_tile();
    return event.has_finished();
  });
  EXPECT_TRUE(anew);
  EXPECT_EQ(since, 16);
}

TEST_F(KeptJobs, PausedAndQueuedOnesStaySo) {
  start();
  const std::uint64_t running = client->submit("gate 0");
  const std::uint64_t queued = client->submit("picture 16 16 8");
  const std::uint64_t paused = client->submit("picture 32 16 8");
  v1::Envelope pause;
  pause.mutable_pause()->set_job_id(paused);
  EXPECT_EQ(client->ask(pause).job_summary().state(), v1::PAUSED);
  end();

  start();
  EXPECT_EQ(client->summary(paused).state(), v1::PAUSED);
  daemon->open_gate();
  EXPECT_EQ(picture(running).size(), 12u);
  EXPECT_EQ(picture(queued).size(), 4u);
  v1::Envelope resume;
  resume.mutable_resume()->set_job_id(paused);
  client->ask(resume);
  EXPECT_EQ(picture(paused).size(), 8u);
}

TEST_F(KeptJobs, APausedOneGivesItsMemoryBackAndGoesOn) {
  start();
  const std::uint64_t job = client->submit("picture 64 64 16 gate 7");
  client->watch(job);
  int tiles = 0;
  client->receive_event_until(
      [&](const v1::JobEvent& event) { return event.has_tile() && ++tiles == 7; });
  v1::Envelope pause;
  pause.mutable_pause()->set_job_id(job);
  EXPECT_EQ(client->ask(pause).job_summary().tiles_done(), 7u);
  end();
  start();
  v1::Envelope resume;
  resume.mutable_resume()->set_job_id(job);
  client->ask(resume);
  daemon->open_gate();
  EXPECT_EQ(picture(job).size(), 16u);
}

TEST_F(KeptJobs, CancelledAndFailedOnesKeepTheirReasons) {
  start();
  const std::uint64_t failed = client->submit("fail");
  client->watch(failed);
  const std::string reason =
      client->receive_event_until([](const v1::JobEvent& event) { return event.has_failed(); })
          .failed()
          .reason();
  const std::uint64_t cancelled = client->submit("gate 1");
  v1::Envelope cancel;
  cancel.mutable_cancel()->set_job_id(cancelled);
  client->ask(cancel);
  end();
  start();
  EXPECT_EQ(client->summary(failed).reason(), reason);
  EXPECT_EQ(client->summary(cancelled).state(), v1::CANCELLED);
  EXPECT_FALSE(
      std::filesystem::exists(state.path() / "jobs" / (std::to_string(cancelled) + ".tiles")));
}

TEST_F(KeptJobs, TheSameSubmitIsOneJobAcrossARestart) {
  start();
  const auto digests = client->upload({"picture 16 16 8", "picture 8 8 8"});
  v1::Envelope submit;
  submit.mutable_submit()->set_scene_sha256(digests[0]);
  submit.mutable_submit()->set_client_key("0123456789abcdef");
  const std::uint64_t job = client->ask(submit).submitted().job_id();
  EXPECT_EQ(client->ask(submit).submitted().job_id(), job);
  end();
  start();
  client->upload({"picture 16 16 8", "picture 8 8 8"});
  EXPECT_EQ(client->ask(submit).submitted().job_id(), job);
  submit.mutable_submit()->set_scene_sha256(digests[1]);
  EXPECT_EQ(client->ask(submit).error().code(), v1::Error::STATE);
  submit.mutable_submit()->set_client_key("another key 0000");
  EXPECT_NE(client->ask(submit).submitted().job_id(), job);
}

TEST(RecordRow, NoFlippedBitPasses) {
  v1::JobRecord record;
  record.set_job_id(7);
  record.mutable_plan()->set_width(640);
  record.set_reason("why");
  const std::string row = encode_record(record);
  ASSERT_EQ(decode_record(row)->SerializeAsString(), record.SerializeAsString());
  for (std::size_t bit = 0; bit < 8 * row.size(); ++bit) {
    std::string bad = row;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
    EXPECT_FALSE(decode_record(bad)) << bit;
  }
  for (std::size_t size = 0; size < row.size(); ++size)
    EXPECT_FALSE(decode_record(row.substr(0, size)));
}

TEST_F(KeptJobs, ACheckedOneHasNoTilesToMiss) {
  start();
  const std::uint64_t job = client->submit("picture 64 64 16", true);
  client->watch(job, 0, false);
  client->receive_event_until([](const v1::JobEvent& event) { return event.has_finished(); });
  end();
  start();
  EXPECT_TRUE(picture(job).empty());
}

TEST_F(KeptJobs, ATileThatTheDiskHasLostIsRenderedAgain) {
  start();
  const std::uint64_t job = client->submit("picture 64 64 16 gate 5");
  client->watch(job);
  std::vector<v1::Tile> tiles;
  client->receive_event_until([&](const v1::JobEvent& event) {
    if (event.has_tile()) tiles.push_back(event.tile());
    return tiles.size() == 5;
  });
  end();
  std::fstream file(state.path() / "jobs" / (std::to_string(job) + ".tiles"),
                    std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(100);
  file.put('!');
  file.close();
  start();
  daemon->open_gate();
  const auto whole = picture(job);
  EXPECT_EQ(whole.size(), 16u);
  EXPECT_EQ(whole.at({tiles[0].x(), tiles[0].y()}), tiles[0].xyz());
  end();
  start();
  EXPECT_EQ(picture(job), whole);
}

TEST_F(KeptJobs, ARecordThatCantBeReadIsAFailedJobAndTheRestGoesOn) {
  start();
  const std::uint64_t bad = finished("picture 16 16 8");
  const std::uint64_t good = finished("picture 24 16 8");
  end();
  run(("UPDATE jobs SET record=x'ff00ff' WHERE id=" + std::to_string(bad)).c_str());
  start();
  EXPECT_EQ(client->summary(bad).state(), v1::FAILED);
  EXPECT_EQ(client->summary(bad).reason(), "its record in the state is damaged");
  EXPECT_EQ(picture(good).size(), 6u);
}

TEST_F(KeptJobs, ADamagedPictureIsSaidToBeSo) {
  start();
  const std::uint64_t job = finished("picture 64 64 16");
  end();
  const auto path = state.path() / "jobs" / (std::to_string(job) + ".tiles");
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(60);
  file.put('!');
  file.close();
  start();
  v1::Envelope watch;
  watch.set_request_id(77);
  watch.mutable_watch()->set_job_id(job);
  watch.mutable_watch()->set_tiles(true);
  client->send(watch);
  std::optional<v1::Envelope> got;
  while ((got = client->receive()) && !got->has_error()) {
  }
  ASSERT_TRUE(got);
  EXPECT_EQ(got->error().code(), v1::Error::INTERNAL);
  EXPECT_NE(got->error().message().find("is damaged"), std::string::npos);

  std::filesystem::remove(path);
  end();
  start();
  EXPECT_EQ(client->ask(watch).error().code(), v1::Error::INTERNAL);
  client->ping();
}

TEST_F(KeptJobs, WhatIsDroppedIsGoneFromTheDisk) {
  start([](ServiceOptions& options) { options.keep_bytes = 4000; });
  const std::uint64_t first = finished("picture 16 16 8");
  const std::uint64_t second = finished("picture 16 16 8");
  end();
  EXPECT_FALSE(std::filesystem::exists(state.path() / "jobs" / (std::to_string(first) + ".tiles")));
  EXPECT_TRUE(std::filesystem::exists(state.path() / "jobs" / (std::to_string(second) + ".tiles")));
  start();
  EXPECT_EQ(client->summary(second).state(), v1::FINISHED);
}

TEST_F(KeptJobs, TwoDaemonsDoNotShareAState) {
  start();
  try {
    Daemon other([&](ServiceOptions& options) { options.state = state.path(); });
    ADD_FAILURE() << "both have it";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("another metamerd has the state"), std::string::npos);
  }
}

TEST_F(KeptJobs, AStateOfALaterVersionIsLeftAlone) {
  start();
  end();
  run("PRAGMA user_version=1000");
  try {
    start();
    ADD_FAILURE() << "it was opened";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("start the newer metamerd"), std::string::npos);
  }
}

}  // namespace
}  // namespace metamer::service::test
