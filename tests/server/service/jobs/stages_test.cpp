// What a job's watchers hear before its first tile.

#include <gtest/gtest.h>

#include "../daemon.h"

namespace metamer::service::test {

namespace {

/// The names of the events up to the last, and what was said to be prepared.
struct Heard {
  std::vector<std::string> names;
  std::vector<v1::Prepared> prepared;
  v1::JobEvent last;
};

Heard listen(Client& client, std::uint64_t job) {
  client.watch(job);
  Heard heard;
  heard.last = client.receive_event_until([&](const v1::JobEvent& event) {
    const auto* oneof = v1::JobEvent::descriptor()->FindOneofByName("event");
    const std::string& name = event.GetReflection()->GetOneofFieldDescriptor(event, oneof)->name();
    if (event.has_prepared()) heard.prepared.push_back(event.prepared());
    if (event.has_preparing())
      heard.names.push_back(v1::Preparing::Stage_Name(event.preparing().stage()));
    else if (heard.names.empty() || heard.names.back() != name)
      heard.names.push_back(name);
    return event.has_finished();
  });
  return heard;
}

std::uint64_t submit(Client& client, const std::string& scene, bool check_only, bool prepare) {
  v1::Envelope message;
  message.mutable_submit()->set_scene_sha256(client.upload({scene})[0]);
  message.mutable_submit()->set_check_only(check_only);
  message.mutable_submit()->set_prepare(prepare);
  return client.ask(message).submitted().job_id();
}

using Names = std::vector<std::string>;

}  // namespace

TEST(Stages, OnlyTheNewestIsKeptAndWhatTheyTookAlways) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const auto job = client.submit("picture 32 16 16 stages");
  const Heard first = listen(client, job);
  ASSERT_EQ(first.prepared.size(), 1u);
  const v1::Timing& timing = first.prepared[0].timing();
  EXPECT_EQ(timing.compile(), 0.25);
  EXPECT_EQ(timing.acceleration(), 0.5);
  EXPECT_EQ(timing.pilot(), 1);
  EXPECT_EQ(timing.prepare(), 2);
  EXPECT_EQ(timing.pass_size(), 0) << "no more is kept than was asked for";

  // Who comes late hears of the last stage.
  EXPECT_EQ(listen(client, job).names, (Names{"queued", "started", "planned", "HIERARCHY",
                                              "prepared", "tile", "progress", "finished"}));
}

TEST(Stages, EachStartHasItsOwn) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const Heard heard = listen(client, client.submit("stages once crash 5"));
  EXPECT_EQ(heard.prepared.size(), 2u);
  EXPECT_TRUE(heard.last.has_finished());
}

TEST(Stages, ACheckThatPreparesEndsWithTheTimesAndWithoutAPicture) {
  Daemon daemon;
  Client client(daemon.socket());
  client.hello();
  const Heard heard = listen(client, submit(client, "picture 32 16 16", true, true));
  EXPECT_EQ(heard.names, (Names{"queued", "started", "planned", "prepared", "finished"}));
  const v1::Timing& timing = heard.last.finished().timing();
  EXPECT_EQ(timing.acceleration(), 0.5);
  EXPECT_EQ(timing.prepare(), 2);
  EXPECT_EQ(timing.render(), 0);
  EXPECT_EQ(timing.rays(), 0u);

  // Neither alone: what is rendered is prepared anyway, and what is checked is not.
  EXPECT_EQ(listen(client, submit(client, "picture 32 16 16", false, true)).prepared.size(), 0u);
  EXPECT_EQ(listen(client, submit(client, "picture 32 16 16", true, false)).names,
            (Names{"queued", "started", "planned", "finished"}));
}

TEST(Stages, AWorkerThatSaysThemAtAnotherTimeIsEnded) {
  for (const std::string trouble : {"stages prepared 0", "prepared 3", "preparing 3"}) {
    Daemon daemon;
    Client client(daemon.socket());
    client.hello();
    client.watch(client.submit("once " + trouble));
    const auto retrying =
        client.receive_event_until([](auto& event) { return event.has_retrying(); });
    EXPECT_NE(retrying.retrying().reason().find("what was not asked for"), std::string::npos)
        << retrying.ShortDebugString();
    client.receive_event_until([](auto& event) { return event.has_finished(); });
  }
}

}  // namespace metamer::service::test
