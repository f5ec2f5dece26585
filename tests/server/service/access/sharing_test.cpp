// What one client takes of what all share: another one still gets in, and gets its job done.

#include <gtest/gtest.h>
#include <unistd.h>

#include "../daemon.h"
#include "common/digest.h"
#include "server/service/limits.h"

namespace metamer::service::test {

namespace {

using Clients = std::vector<std::unique_ptr<Client>>;

/// The first bytes of an asset.
v1::Envelope begin_upload(const std::string& name, std::uint64_t size) {
  v1::Envelope message;
  message.mutable_asset_chunk()->set_sha256(std::string(to_bytes(sha256(name))));
  message.mutable_asset_chunk()->set_size(size);
  message.mutable_asset_chunk()->set_data("x");
  return message;
}

v1::Envelope order(void (*fill)(v1::Envelope&, std::uint64_t), std::uint64_t job) {
  v1::Envelope message;
  fill(message, job);
  return message;
}

void cancel(v1::Envelope& message, std::uint64_t job) { message.mutable_cancel()->set_job_id(job); }
void pause(v1::Envelope& message, std::uint64_t job) { message.mutable_pause()->set_job_id(job); }
void resume(v1::Envelope& message, std::uint64_t job) { message.mutable_resume()->set_job_id(job); }

constexpr std::size_t places = 64;
void give_few_places(ServiceOptions& options) { options.limits.sessions = places; }

/// Two peers: one by the Unix socket, one by TCP.
class Sharing : public testing::Test {
 protected:
  Daemon daemon_{give_few_places};

  /// `meanwhile` comes between its submission and its end.
  void expect_another_gets_its_job_done(const std::function<void()>& meanwhile = [] {}) {
    Client other(daemon_.port());
    other.hello();
    const auto job = other.submit("picture 64 48 16");
    other.watch(job);
    meanwhile();
    other.receive_event_until([](auto& event) { return event.has_finished(); });
  }
};

}  // namespace

TEST_F(Sharing, SessionsThatSayNothingLeaveRoomForOthers) {
  Clients clients;
  std::optional<v1::Envelope> refused;
  while (!refused && clients.size() < 2 * places) {
    clients.push_back(std::make_unique<Client>(daemon_.socket()));
    v1::Envelope hello;
    hello.mutable_hello()->set_protocol_version(1);
    clients.back()->send(hello);
    const auto answer = clients.back()->receive();
    if (answer && answer->has_error()) refused = answer;
  }
  ASSERT_TRUE(refused);
  EXPECT_EQ(clients.size() - 1, places / 8 * 7);
  EXPECT_EQ(refused->error().code(), v1::Error::LIMIT);
  EXPECT_EQ(refused->error().message(),
            "uid " + std::to_string(::getuid()) +
                " has its share of the server's 64 sessions; try again later");
  EXPECT_TRUE(clients.back()->closed_by_server());
  expect_another_gets_its_job_done();
  // A place that is given up is free again.
  clients.erase(clients.begin());
  while (clients.front()->info().sessions() == places / 8 * 7) {
  }
  Client(daemon_.socket()).hello();
}

TEST_F(Sharing, UploadsTakeRoomOnlyAsTheyCome) {
  Clients clients;
  for (int i = 0; i < 8; ++i) {  // 8 GiB in all, which is the store
    clients.push_back(std::make_unique<Client>(daemon_.socket()));
    clients.back()->hello();
    clients.back()->send(begin_upload(std::to_string(i), 1u << 30));
    clients.back()->ping();
  }
  expect_another_gets_its_job_done();
  EXPECT_LT(clients[0]->info().store_bytes(), 1000u);
}

TEST_F(Sharing, AClientThatDoesNotReadItsAnswersIsNotServedOn) {
  Client greedy(daemon_.socket());
  Client other(daemon_.socket());
  greedy.hello();
  other.hello();
  greedy.submit("gate 0");
  const std::string scene = greedy.upload({"picture 64 48 16"})[0];
  std::uint64_t last = 0;
  for (int i = 0; i < 200; ++i) {
    v1::Envelope message;
    message.mutable_submit()->set_name(std::string(max_job_name, 'x'));
    message.mutable_submit()->set_scene_sha256(scene);
    last = greedy.ask(message).submitted().job_id();
  }
  // Some 3 MB of answers, and at the end something that others can see.
  std::string bytes;
  for (int i = 0; i < 60; ++i) {
    v1::Envelope message;
    message.mutable_list_jobs();
    bytes += wire::encode_frame(message.SerializeAsString());
  }
  v1::Envelope message = order(cancel, last);
  message.set_request_id(77);
  bytes += wire::encode_frame(message.SerializeAsString());
  greedy.send_bytes(bytes);
  for (int i = 0; i < 100; ++i) other.ping();
  EXPECT_EQ(other.summary(last).state(), v1::QUEUED);
  // Once they are read it goes on.
  std::optional<v1::Envelope> answer;
  do answer = greedy.receive();
  while (answer && answer->request_id() != 77);
  EXPECT_EQ(other.summary(last).state(), v1::CANCELLED);
}

TEST_F(Sharing, AQueueFullOfOnesJobsTakesAndRendersAnothers) {
  Client greedy(daemon_.socket());
  greedy.hello();
  const auto gate = greedy.submit("gate 1");
  const std::string scene = greedy.upload({"gate 0"})[0];
  v1::Envelope message;
  message.mutable_submit()->set_scene_sha256(scene);
  v1::Envelope answer;
  do answer = greedy.ask(message);
  while (answer.has_submitted());
  EXPECT_EQ(answer.error().code(), v1::Error::LIMIT);
  greedy.watch(gate);
  greedy.receive_event_until([](auto& event) { return event.has_tile(); });
  expect_another_gets_its_job_done([&] { daemon_.open_gate(); });
}

TEST_F(Sharing, ViewsOfOneLeaveRoomForAnothers) {
  Clients clients;
  v1::Envelope answer;
  do {
    if (clients.size() > max_views) break;
    clients.push_back(std::make_unique<Client>(daemon_.socket()));
    clients.back()->hello();
    const std::string scene = clients.back()->upload({"picture 8 8 8"})[0];
    for (std::size_t i = 0; i < max_session_views && !answer.has_error(); ++i) {
      v1::Envelope message;
      message.mutable_open_view()->set_scene_sha256(scene);
      clients.back()->send(message);
      v1::Envelope after;
      after.mutable_ping();
      clients.back()->send(after);
      answer = *clients.back()->receive();
    }
  } while (!answer.has_error());
  ASSERT_TRUE(answer.has_error());
  Client other(daemon_.port());
  other.hello();
  v1::Envelope message;
  message.mutable_open_view()->set_scene_sha256(other.upload({"picture 8 8 8"})[0]);
  other.send(message);
  v1::Envelope after;
  after.mutable_ping();
  other.send(after);
  const auto next = other.receive();
  ASSERT_TRUE(next);
  EXPECT_TRUE(next->has_pong()) << next->ShortDebugString();
}

TEST_F(Sharing, AJobIsThereForItsUserAndTheServersOwnerAlone) {
  Client owner(daemon_.socket());
  Client stranger(daemon_.port());
  owner.hello();
  stranger.hello();
  const auto theirs = owner.submit("gate 0");
  const auto own = stranger.submit("picture 64 48 16");
  for (const auto fill : {pause, resume, cancel}) {
    const v1::Envelope answer = stranger.ask(order(fill, theirs));
    ASSERT_TRUE(answer.has_error()) << answer.ShortDebugString();
    EXPECT_EQ(answer.error().code(), v1::Error::NOT_FOUND);
    EXPECT_EQ(answer.error().message(), "there is no job " + std::to_string(theirs));
  }
  v1::Envelope watch;
  watch.mutable_watch()->set_job_id(theirs);
  EXPECT_EQ(stranger.ask(watch).error().message(), "there is no job " + std::to_string(theirs));
  EXPECT_EQ(stranger.summary(theirs).job_id(), 0u);
  EXPECT_EQ(stranger.summary(own).user(), "127.0.0.1");
  EXPECT_EQ(owner.summary(own).user(), "127.0.0.1");
  EXPECT_EQ(owner.summary(theirs).state(), v1::RUNNING);
  // Another session of the same peer counts as the same.
  Client again(daemon_.port());
  again.hello();
  EXPECT_TRUE(again.ask(order(pause, own)).has_job_summary());
  EXPECT_TRUE(owner.ask(order(cancel, own)).has_job_summary());
  EXPECT_TRUE(owner.ask(order(cancel, theirs)).has_job_summary());
}

TEST(Patience, AnIdleSessionMakesRoomForOneOfTheSamePeer) {
  Daemon daemon([](ServiceOptions& options) {
    give_few_places(options);
    options.patience.idle_session = {};
  });
  Client watching(daemon.socket());
  watching.hello();
  const auto job = watching.submit("gate 0");
  watching.watch(job);
  watching.receive_event_until([](auto& event) { return event.has_planned(); });
  Clients clients;
  for (std::size_t i = 0; i < 2 * places; ++i) {
    clients.push_back(std::make_unique<Client>(daemon.socket()));
    clients.back()->hello();
  }
  EXPECT_TRUE(clients.front()->closed_by_server());
  clients.back()->ping();
  // Who waits for something is not idle.
  daemon.open_gate();
  watching.receive_event_until([](auto& event) { return event.has_finished(); });
}

TEST(Patience, AnUploadThatStandsStillGivesItsRoomBack) {
  Daemon daemon(
      [](ServiceOptions& options) { options.patience.upload = std::chrono::milliseconds(1); });
  Client client(daemon.socket());
  client.hello();
  client.send(begin_upload("x", 5));
  while (client.info().store_bytes() > 0) {
  }
  v1::Envelope next = begin_upload("x", 5);
  next.mutable_asset_chunk()->set_offset(1);
  EXPECT_EQ(client.ask(next).error().message(),
            "an asset's first chunk has to be at offset 0, not 1");
}

}  // namespace metamer::service::test
