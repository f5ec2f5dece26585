// A watch gives what comes, in order, and ends with its job, with its caller or with the
// connection.
#include <gtest/gtest.h>

#include <thread>

#include "client/session/session.h"
#include "fake_server.h"

namespace metamer::test {
namespace {

namespace asio = boost::asio;
using Kind = SessionError::Kind;
using Envelopes = std::vector<v1::Envelope>;

TEST(Watch, GivesEventsUpToTheLastAndNoFurther) {
  FakeServer server([](const v1::Envelope& request) -> Envelopes {
    if (request.has_hello()) return {welcome()};
    return {event(3), event(4), last_event(7), event(8)};
  });
  std::vector<std::uint64_t> seen;
  EXPECT_FALSE(server.run([&](Session& session) -> asio::awaitable<void> {
    Session::OnEvent on_event = [&](const v1::JobEvent& one) -> Answer<void> {
      seen.push_back(one.sequence());
      return {};
    };
    const Answer<void> watched = co_await session.watch({}, on_event);
    EXPECT_TRUE(watched);
  }));
  EXPECT_EQ(seen, (std::vector<std::uint64_t>{3, 4, 7}));
}

TEST(Watch, ManyMoreEventsThanAnInboxHoldsComeInOrder) {
  FakeServer server([](const v1::Envelope& request) -> Envelopes {
    if (request.has_hello()) return {welcome()};
    Envelopes events;
    for (std::uint64_t i = 1; i <= 1000; ++i) events.push_back(event(i));
    events.push_back(last_event(1001));
    return events;
  });
  std::uint64_t last = 0;
  EXPECT_FALSE(server.run([&](Session& session) -> asio::awaitable<void> {
    Session::OnEvent on_event = [&](const v1::JobEvent& one) -> Answer<void> {
      EXPECT_EQ(one.sequence(), last + 1);
      last = one.sequence();
      return {};
    };
    const Answer<void> watched = co_await session.watch({}, on_event);
    EXPECT_TRUE(watched);
  }));
  EXPECT_EQ(last, 1001u);
}

TEST(Watch, ACallersErrorEndsItAndTheSessionGoesOn) {
  FakeServer server([](const v1::Envelope& request) -> Envelopes {
    if (request.has_hello()) return {welcome()};
    if (request.has_watch()) {
      Envelopes events;
      for (std::uint64_t i = 1; i <= 100; ++i) events.push_back(event(i));
      return events;
    }
    v1::Envelope pong;
    pong.mutable_pong();
    return {pong};
  });
  EXPECT_FALSE(server.run([](Session& session) -> asio::awaitable<void> {
    Session::OnEvent on_event = [](const v1::JobEvent&) -> Answer<void> {
      return session_error(Kind::input, "enough");
    };
    const Answer<void> watched = co_await session.watch({}, on_event);
    EXPECT_FALSE(watched);
    if (!watched) {
      EXPECT_EQ(watched.error().message, "enough");
    }
    const Answer<double> ping = co_await session.ping();
    EXPECT_TRUE(ping);
  }));
}

/// A server of a job that never ends: it says one event of it, and `answer` to Unwatch.
struct EndlessJob {
  explicit EndlessJob(v1::Envelope to_unwatch) : answer(std::move(to_unwatch)) {}

  v1::Envelope answer;
  std::uint64_t watch = 0;
  std::vector<std::uint64_t> unwatched;

  Envelopes answer_to(const v1::Envelope& request) {
    if (request.has_hello()) return {welcome()};
    if (request.has_watch()) {
      watch = request.request_id();
      return {event(1)};
    }
    if (request.has_unwatch()) {
      unwatched.push_back(request.unwatch().watch());
      return {answer};
    }
    v1::Envelope pong;
    pong.mutable_pong();
    return {pong};
  }
};

v1::Envelope unwatched() {
  v1::Envelope envelope;
  envelope.mutable_unwatched();
  return envelope;
}

TEST(Watch, EndsWhenItIsStoppedWhateverTheServerKnows) {
  const Envelopes answers = {unwatched(), error(v1::Error::UNKNOWN_MESSAGE, "what is that?"),
                             error(v1::Error::NOT_FOUND, "there is no watch 2")};
  for (const v1::Envelope& answer : answers) {
    for (const bool from_another_thread : {false, true}) {
      EndlessJob job(answer);
      FakeServer server([&](const v1::Envelope& request) { return job.answer_to(request); });
      EXPECT_FALSE(server.run([&](Session& session) -> asio::awaitable<void> {
        std::stop_source stop;
        std::thread stopper;
        Session::OnEvent on_event = [&](const v1::JobEvent&) -> Answer<void> {
          if (from_another_thread) {
            stopper = std::thread([&] {
              std::this_thread::sleep_for(std::chrono::milliseconds(5));
              stop.request_stop();
            });
          } else {
            stop.request_stop();
          }
          return {};
        };
        const Answer<void> watched = co_await session.watch({}, on_event, stop.get_token());
        EXPECT_TRUE(watched);
        const Answer<double> ping = co_await session.ping();
        EXPECT_TRUE(ping);
        if (stopper.joinable()) stopper.join();
      }));
      EXPECT_EQ(job.unwatched, std::vector<std::uint64_t>{job.watch});
    }
  }
}

TEST(Watch, ThatWasStoppedBeforeItBeganGivesNoEvent) {
  EndlessJob job(unwatched());
  FakeServer server([&](const v1::Envelope& request) { return job.answer_to(request); });
  EXPECT_FALSE(server.run([&](Session& session) -> asio::awaitable<void> {
    std::stop_source stop;
    stop.request_stop();
    Session::OnEvent on_event = [](const v1::JobEvent&) -> Answer<void> {
      ADD_FAILURE();
      return {};
    };
    const Answer<void> watched = co_await session.watch({}, on_event, stop.get_token());
    EXPECT_TRUE(watched);
    const Answer<double> ping = co_await session.ping();
    EXPECT_TRUE(ping);
  }));
  EXPECT_EQ(job.unwatched, std::vector<std::uint64_t>{job.watch});
}

TEST(Watch, OfALostConnectionIsAnErrorThoughItIsStoppedLater) {
  FakeServer server([](const v1::Envelope& request) -> Envelopes {
    if (request.has_hello()) return {welcome()};
    return {event(1), {}};
  });
  EXPECT_FALSE(server.run([](Session& session) -> asio::awaitable<void> {
    std::stop_source stop;
    Session::OnEvent on_event = [](const v1::JobEvent&) -> Answer<void> { return {}; };
    const Answer<void> watched = co_await session.watch({}, on_event, stop.get_token());
    EXPECT_FALSE(watched);
    stop.request_stop();
  }));
}

TEST(Watch, LostConnectionInTheMiddleIsTold) {
  FakeServer server([](const v1::Envelope& request) -> Envelopes {
    if (request.has_hello()) return {welcome()};
    return {event(1), {}};
  });
  EXPECT_FALSE(server.run([](Session& session) -> asio::awaitable<void> {
    Session::OnEvent on_event = [](const v1::JobEvent&) -> Answer<void> { return {}; };
    const Answer<void> watched = co_await session.watch({}, on_event);
    EXPECT_FALSE(watched);
    if (!watched) {
      EXPECT_EQ(watched.error().kind, Kind::disconnected);
    }
    // From now on every request says so.
    const Answer<v1::JobList> jobs = co_await session.list();
    EXPECT_FALSE(jobs);
    if (!jobs) {
      EXPECT_EQ(jobs.error().kind, Kind::disconnected);
    }
  }));
}

}  // namespace
}  // namespace metamer::test
