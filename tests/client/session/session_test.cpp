// A session keeps its side of the protocol, and says what is wrong when the server does not.
#include "client/session/session.h"

#include <gtest/gtest.h>

#include "fake_server.h"

namespace metamer::test {
namespace {

namespace asio = boost::asio;
using Kind = SessionError::Kind;
using Envelopes = std::vector<v1::Envelope>;

asio::awaitable<void> nothing(Session&) { co_return; }

TEST(Handshake, NamesProgramAndVersion) {
  v1::Hello hello;
  FakeServer server([&](const v1::Envelope& request) {
    hello = request.hello();
    return Envelopes{welcome()};
  });
  EXPECT_FALSE(server.run(nothing));
  EXPECT_EQ(hello.protocol_version(), 1u);
  EXPECT_EQ(hello.client(), "metamer " METAMER_VERSION);
}

TEST(Handshake, VersionErrorIsTold) {
  FakeServer server([](const v1::Envelope&) {
    return Envelopes{error(v1::Error::VERSION, "this server speaks version 2"), {}};
  });
  const auto failure = server.run(nothing);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, Kind::version);
  EXPECT_EQ(failure->message, "this server speaks version 2");
}

TEST(Handshake, AnotherVersionInWelcomeIsAnError) {
  FakeServer server([](const v1::Envelope&) { return Envelopes{welcome(7)}; });
  const auto failure = server.run(nothing);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, Kind::version);
}

TEST(Handshake, AServerThatClosesIsLost) {
  FakeServer server([](const v1::Envelope&) { return Envelopes{{}}; });
  const auto failure = server.run(nothing);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, Kind::disconnected);
  EXPECT_NE(failure->message.find("lost the connection to unix:"), std::string::npos);
}

TEST(Handshake, AServerThatSaysNothingIsGivenUp) {
  FakeServer server([](const v1::Envelope&) { return Envelopes{}; });
  ConnectLimits limits;
  limits.welcome = std::chrono::milliseconds(50);
  const auto failure = server.run(nothing, limits);
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, Kind::disconnected);
  EXPECT_TRUE(failure->message.starts_with("lost the connection to unix:")) << failure->message;
  EXPECT_TRUE(failure->message.ends_with("/socket: it did not answer the handshake"))
      << failure->message;
}

TEST(Handshake, EndsWhenItIsCancelled) {
  asio::cancellation_signal cancel;
  FakeServer server([&](const v1::Envelope&) {
    cancel.emit(asio::cancellation_type::terminal);
    return Envelopes{};
  });
  const auto failure = server.run(nothing, {}, cancel.slot());
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->kind, Kind::no_server);
  EXPECT_TRUE(failure->message.starts_with("can't connect to unix:")) << failure->message;
  EXPECT_TRUE(failure->message.ends_with("/socket: Operation canceled")) << failure->message;
}

/// What an upload meets: which digests were offered, what arrived, and the job's request.
struct Store {
  bool has_all = false;
  std::vector<std::string> offered;
  std::map<std::string, std::string> arrived;
  std::vector<std::size_t> chunk_sizes;
  bool submitted = false;

  Envelopes answer(const v1::Envelope& request) {
    v1::Envelope reply;
    if (request.has_hello()) return {welcome()};
    if (request.has_offer_assets()) {
      for (const std::string& digest : request.offer_assets().sha256()) {
        offered.push_back(digest);
        if (!has_all) reply.mutable_missing_assets()->add_sha256(digest);
      }
      reply.mutable_missing_assets();
      return {reply};
    }
    if (request.has_asset_chunk()) {
      const v1::AssetChunk& chunk = request.asset_chunk();
      std::string& bytes = arrived[chunk.sha256()];
      EXPECT_EQ(chunk.offset(), bytes.size());
      bytes += chunk.data();
      chunk_sizes.push_back(chunk.data().size());
      if (bytes.size() < chunk.size()) return {};
      reply.mutable_asset_stored()->set_sha256(chunk.sha256());
      return {reply};
    }
    EXPECT_TRUE(request.has_submit());
    submitted = true;
    reply.mutable_submitted()->set_job_id(42);
    return {reply};
  }
};

Submission lamp_submission() {
  v1::Scene scene;
  scene.add_light()->set_name("a lamp with a name of some length");
  return make_submission(scene, {}, "s.txtpb", false);
}

/// Submits, and gives the answer.
Answer<std::uint64_t> submit_to(FakeServer& server, const Submission& submission) {
  std::optional<Answer<std::uint64_t>> result;
  EXPECT_FALSE(server.run([&](Session& session) -> asio::awaitable<void> {
    result = co_await session.submit(submission);
  }));
  return *result;
}

TEST(Submit, SendsWhatIsMissingInChunksWithinTheLimit) {
  Store store;
  FakeServer server([&](const v1::Envelope& request) { return store.answer(request); });
  const Submission submission = lamp_submission();
  const Answer<std::uint64_t> job = submit_to(server, submission);
  ASSERT_TRUE(job);
  EXPECT_EQ(*job, 42u);
  EXPECT_EQ(store.arrived[submission.request.scene_sha256()], submission.uploads[0].bytes);
  EXPECT_GT(store.chunk_sizes.size(), 1u);
  for (const std::size_t size : store.chunk_sizes) EXPECT_LE(size, 10u);
}

TEST(Submit, SendsNothingThatTheServerHas) {
  Store store;
  store.has_all = true;
  FakeServer server([&](const v1::Envelope& request) { return store.answer(request); });
  ASSERT_TRUE(submit_to(server, lamp_submission()));
  EXPECT_EQ(store.offered.size(), 1u);
  EXPECT_TRUE(store.arrived.empty());
  EXPECT_TRUE(store.submitted);
}

TEST(Submit, StopsAtARefusedChunk) {
  Store store;
  FakeServer server([&](const v1::Envelope& request) -> Envelopes {
    if (request.has_asset_chunk() && request.asset_chunk().offset() >= 10)
      return {error(v1::Error::LIMIT, "the store is full")};
    return store.answer(request);
  });
  const Answer<std::uint64_t> job = submit_to(server, lamp_submission());
  ASSERT_FALSE(job);
  EXPECT_EQ(job.error().kind, Kind::refused);
  EXPECT_EQ(job.error().code, v1::Error::LIMIT);
  EXPECT_EQ(job.error().message, "the store is full");
  EXPECT_FALSE(store.submitted);
}

TEST(Submit, KeepsToTheServersLimitsWithoutAsking) {
  Store store;
  FakeServer server([&](const v1::Envelope& request) { return store.answer(request); });
  Submission submission = lamp_submission();
  submission.uploads.resize(4);
  const Answer<std::uint64_t> job = submit_to(server, submission);
  ASSERT_FALSE(job);
  EXPECT_EQ(job.error().kind, Kind::input);
  EXPECT_EQ(job.error().message, "the scene and its files are 4 assets; the server takes 3");
  EXPECT_TRUE(store.offered.empty());
}

TEST(Submit, RefusesAnAssetOverTheLimit) {
  Store store;
  FakeServer server([&](const v1::Envelope& request) { return store.answer(request); });
  v1::Scene scene;
  scene.add_light()->set_name(std::string(2000, 'x'));
  const Submission submission = make_submission(scene, {}, "s.txtpb", false);
  const Answer<std::uint64_t> job = submit_to(server, submission);
  ASSERT_FALSE(job);
  EXPECT_EQ(job.error().message, "s.txtpb has " + std::to_string(submission.uploads[0].size) +
                                     " bytes; the server takes 1000");
  EXPECT_TRUE(store.arrived.empty());
}

TEST(Requests, MayOverlap) {
  // The job's end comes only after it was cancelled, which happens while it is watched.
  std::uint64_t watch_id = 0;
  FakeServer server([&](const v1::Envelope& request) -> Envelopes {
    if (request.has_hello()) return {welcome()};
    if (request.has_watch()) {
      watch_id = request.request_id();
      return {event(1)};
    }
    v1::Envelope summary;
    summary.mutable_job_summary()->set_state(v1::CANCELLED);
    return {summary};
  });
  bool cancelled = false;
  EXPECT_FALSE(server.run([&](Session& session) -> asio::awaitable<void> {
    const auto executor = co_await asio::this_coro::executor;
    const auto cancel = [&]() -> asio::awaitable<void> {
      const Answer<v1::JobSummary> answer = co_await session.cancel(1);
      cancelled = answer && answer->state() == v1::CANCELLED;
    };
    Session::OnEvent on_event = [&](const v1::JobEvent&) -> Answer<void> {
      return session_error(Kind::input, "seen");
    };
    asio::co_spawn(executor, cancel(), asio::detached);
    const Answer<void> watched = co_await session.watch({}, on_event);
    EXPECT_FALSE(watched);
    const Answer<v1::JobSummary> paused = co_await session.pause(1);
    EXPECT_TRUE(paused);
  }));
  EXPECT_TRUE(cancelled);
  EXPECT_NE(watch_id, 0u);
}

TEST(Requests, AListComesInAsManyAnswersAsItTakes) {
  bool mine = true;
  FakeServer server([&](const v1::Envelope& request) -> Envelopes {
    if (request.has_hello()) return {welcome()};
    mine = mine && request.list_jobs().mine();
    const std::uint64_t after = request.list_jobs().after();
    v1::Envelope page;
    for (std::uint64_t id = after + 1; id <= std::min<std::uint64_t>(after + 3, 8); ++id)
      page.mutable_job_list()->add_job()->set_job_id(id);
    page.mutable_job_list()->set_more(after + 3 < 8);
    return {page};
  });
  EXPECT_FALSE(server.run([](Session& session) -> asio::awaitable<void> {
    const Answer<v1::JobList> jobs = co_await session.list(true);
    EXPECT_TRUE(jobs);
    if (!jobs) co_return;
    EXPECT_EQ(jobs->job_size(), 8);
    for (int i = 0; i < jobs->job_size(); ++i)
      EXPECT_EQ(jobs->job(i).job_id(), static_cast<std::uint64_t>(i + 1));
    EXPECT_FALSE(jobs->more());
  }));
  EXPECT_TRUE(mine);
}

TEST(Requests, AListThatPromisesMoreAndHasNoneEnds) {
  FakeServer server([&](const v1::Envelope& request) -> Envelopes {
    if (request.has_hello()) return {welcome()};
    v1::Envelope page;
    page.mutable_job_list()->set_more(true);
    return {page};
  });
  EXPECT_FALSE(server.run([](Session& session) -> asio::awaitable<void> {
    const Answer<v1::JobList> jobs = co_await session.list();
    EXPECT_TRUE(jobs && jobs->job_size() == 0);
  }));
}

TEST(Requests, AnAnswerOfAnotherKindIsAnError) {
  FakeServer server([](const v1::Envelope&) { return Envelopes{welcome()}; });
  EXPECT_FALSE(server.run([](Session& session) -> asio::awaitable<void> {
    const Answer<v1::JobList> jobs = co_await session.list();
    EXPECT_FALSE(jobs);
    if (!jobs) {
      EXPECT_EQ(jobs.error().message, "the server sent an answer that fits no question");
    }
  }));
}

}  // namespace
}  // namespace metamer::test
