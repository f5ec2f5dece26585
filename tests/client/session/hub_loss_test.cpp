// What a hub does where the server, or what draws for it, is lost, slow or old.
#include <gtest/gtest.h>

#include <latch>

#include "client/session/restart_limit.h"
#include "client/session/scene_change.h"
#include "hub_watching.h"

namespace metamer::test {
namespace {

using Envelopes = std::vector<v1::Envelope>;

Submission lit_by(const std::string& lamp) {
  v1::Scene scene;
  scene.add_light()->set_name(lamp);
  return make_submission(scene, {}, "s.txtpb", false);
}

v1::UpdateView seen_under(double degrees) {
  v1::UpdateView change;
  change.mutable_camera()->set_vertical_fov(degrees);
  return change;
}

Upload file_of(std::uint64_t size) {
  Upload file;
  file.name = "a";
  file.size = size;
  return file;
}

TEST(RestartLimit, IsThreeTimesAMinute) {
  RestartLimit limit;
  const RestartLimit::Clock::time_point start(std::chrono::hours(1));
  for (const int at : {0, 1, 2}) EXPECT_TRUE(limit.take(start + std::chrono::seconds(at)));
  EXPECT_FALSE(limit.take(start + std::chrono::seconds(59)));
  EXPECT_TRUE(limit.take(start + std::chrono::seconds(60)));
  EXPECT_FALSE(limit.take(start + std::chrono::seconds(60)));
  limit.forget();
  EXPECT_TRUE(limit.take(start + std::chrono::seconds(60)));
}

TEST(MergedChanges, AnotherSceneTakesTheirPlaceAndWhatComesAfterItStays) {
  SceneChange waiting{.scene = {}, .rest = seen_under(10), .files = {}};
  merge(SceneChange{.scene = lit_by("lamp"), .rest = {}, .files = {}}, waiting);
  EXPECT_FALSE(waiting.rest.has_camera());
  merge(SceneChange{.scene = {}, .rest = seen_under(20), .files = {file_of(0)}}, waiting);
  merge(SceneChange{.scene = {}, .rest = {}, .files = {file_of(7)}}, waiting);
  EXPECT_TRUE(waiting.scene);
  EXPECT_EQ(waiting.rest.camera().vertical_fov(), 20);
  ASSERT_EQ(waiting.files.size(), 1u) << "a file of each name";
  EXPECT_EQ(waiting.files[0].size, 7u);
}

TEST(LiveView, IsOpenedAnewWithAllThatItWasToldWhereItsWorkerIsLost) {
  ViewAnswers answers(ViewAnswers::never_complete);
  answers.close_once = true;
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  server.beside([&](const std::string& address) {
    Watching watching(address);
    watching.take_each();
    watching.view->change(seen_under(20));
    ASSERT_TRUE(watching.frames.wait(
        [](const auto& all) { return !all.empty() && all.back().revision() == 1; }));
    answers.close_for = v1::Failed::WORKER;
    ASSERT_TRUE(answers.opened.wait([](const auto& all) { return all.size() == 2; }));
    EXPECT_TRUE(watching.interruptions.wait([](const auto& all) { return all.size() == 1; }));
    ASSERT_TRUE(answers.changes.wait([](const auto& all) { return all.size() == 2; }));
    EXPECT_EQ(answers.changes.all()[1].camera().vertical_fov(), 20);
    const std::size_t before = watching.frames.all().size();
    EXPECT_TRUE(watching.frames.wait([&](const auto& all) { return all.size() > before; }));
    EXPECT_TRUE(watching.losses.all().empty());
  });
}

TEST(LiveView, IsLostWhereItsWorkerIsLostAgainAndAgain) {
  ViewAnswers answers(1000);
  answers.close_for = v1::Failed::WORKER;
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  server.beside([&](const std::string& address) {
    Watching watching(address);
    EXPECT_TRUE(watching.losses.wait([](const auto& all) { return all.size() == 1; }));
    EXPECT_EQ(answers.opened.all().size(), 4u);
    EXPECT_EQ(watching.losses.all()[0].message, "signal 9");
  });
}

TEST(LiveView, AChangeThatEndsItIsNoRefusal) {
  ViewAnswers answers(1000);
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  server.beside([&](const std::string& address) {
    Watching watching(address);
    EXPECT_TRUE(watching.frames.wait([](const auto& all) { return all.size() == 2; }));
    answers.close_for = v1::Failed::BAD_INPUT;
    watching.view->taken();
    EXPECT_TRUE(watching.losses.wait([](const auto& all) { return all.size() == 1; }));
    EXPECT_EQ(watching.losses.all()[0].kind, SessionError::Kind::input);
    EXPECT_TRUE(watching.refusals.all().empty());
  });
}

TEST(LiveView, ClosesThoughAFrameThatWasAskedForNeverComes) {
  ViewAnswers answers(1);
  answers.hold_frames = true;
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  server.beside([&](const std::string& address) {
    Watching watching(address);
    EXPECT_TRUE(answers.asked.wait([](const auto& all) { return all.size() == 2; }));
    watching.view.reset();
    EXPECT_TRUE(answers.closed.wait([](const auto& all) { return all.size() == 1; }));
  });
}

TEST(LiveView, ShowsAnotherSceneInTheViewThatIsOpen) {
  ViewAnswers answers(1);
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  server.beside([&](const std::string& address) {
    Watching watching(address);
    const Submission other = lit_by("other");
    watching.take_each();
    watching.view->replace(other);
    ASSERT_TRUE(answers.changes.wait([](const auto& all) { return all.size() == 1; }));
    EXPECT_EQ(answers.changes.all()[0].scene_sha256(), other.request.scene_sha256());
    EXPECT_EQ(answers.changes.all()[0].asset_size(), 0) << "the scene is no file of its own";
    EXPECT_TRUE(watching.frames.wait(
        [](const auto& all) { return !all.empty() && all.back().revision() == 1; }));
    EXPECT_EQ(answers.opened.all().size(), 1u);
    EXPECT_TRUE(answers.closed.all().empty());
  });
}

TEST(LiveView, IsOpenedAnewForAnotherSceneByAServerThatCannotReplaceOne) {
  ViewAnswers answers(1);
  answers.replaces = false;
  answers.hold_frames = true;
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  server.beside([&](const std::string& address) {
    Watching watching(address);
    watching.take_each();
    for (const char* lamp : {"one", "other"}) {
      const Submission other = lit_by(lamp);
      watching.view->replace(other);
      EXPECT_TRUE(answers.opened.wait([&](const auto& all) {
        return !all.empty() && all.back().scene_sha256() == other.request.scene_sha256();
      })) << lamp;
    }
    watching.view->change(seen_under(20));
    EXPECT_TRUE(answers.changes.wait(
        [](const auto& all) { return !all.empty() && all.back().has_camera(); }));
    EXPECT_EQ(answers.closed.all().size(), 2u);
    EXPECT_TRUE(watching.losses.all().empty());
    EXPECT_TRUE(watching.interruptions.all().empty());
  });
}

/// A hub on a server, and the events of job 7 that it hears.
struct Recorded {
  explicit Recorded(const std::string& server, const JobHandle& job = {7, {}})
      : hub([this](const LinkStatus& status) { statuses.add(status); }) {
    hub.open(server);
    EXPECT_TRUE(
        statuses.wait([](const auto& all) { return is_last(all, LinkStatus::Kind::ready); }));
    hub.record(
        job, JobParts::plan, {}, [this](const v1::JobEvent& one) { seen.add(one.sequence()); },
        [this](Answer<JobRecord> record) { done.add(std::move(record)); });
  }
  Came<LinkStatus> statuses;
  Came<std::uint64_t> seen;
  Came<Answer<JobRecord>> done;
  SessionHub hub;
};

TEST(SessionHub, GoesOnWithAJobAtTheNextEventWhereTheSessionWasLost) {
  Came<std::uint64_t> from;
  FakeServer server([&](const v1::Envelope& request) -> Envelopes {
    v1::Envelope pong;
    pong.mutable_pong();
    if (request.has_hello()) return {welcome()};
    if (!request.has_watch()) return {pong};
    from.add(request.watch().from_sequence());
    if (from.all().size() == 1) return {event(3), event(4), v1::Envelope()};
    return {event(6), last_event(7)};
  });
  server.beside([](const std::string& address) {
    Recorded job(address);
    ASSERT_TRUE(job.done.wait([](const auto& all) { return all.size() == 1; }));
    EXPECT_EQ(job.seen.all(), (std::vector<std::uint64_t>{3, 4, 6, 7}));
    ASSERT_TRUE(job.done.all()[0]);
    EXPECT_TRUE(job.done.all()[0]->last.has_cancelled());
  });
  EXPECT_EQ(from.all(), (std::vector<std::uint64_t>{0, 5}));
}

TEST(SessionHub, AJobThatTheNextServerDoesNotKnowHasEndedWithTheOneBefore) {
  int watches = 0;
  FakeServer server([&](const v1::Envelope& request) -> Envelopes {
    v1::Envelope pong;
    pong.mutable_pong();
    if (request.has_hello()) return {welcome()};
    if (!request.has_watch()) return {pong};
    if (watches++ == 0) return {event(3), v1::Envelope()};
    return {error(v1::Error::NOT_FOUND, "no job 7")};
  });
  server.beside([](const std::string& address) {
    Recorded job(address);
    ASSERT_TRUE(job.done.wait([](const auto& all) { return all.size() == 1; }));
    ASSERT_FALSE(job.done.all()[0]);
    EXPECT_EQ(job.done.all()[0].error().message, "the job ended with the server that had it");
  });
}

TEST(SessionHub, AsksNoOtherServerThatStandsThereLaterForAJobOfTheSameNumber) {
  Came<char> greeted, asked;
  FakeServer server([&](const v1::Envelope& request) -> Envelopes {
    v1::Envelope answer;
    if (request.has_hello()) {
      // The one of the state that was thrown away, then another.
      const char id = greeted.all().empty() ? 'a' : 'b';
      greeted.add(id);
      answer = welcome();
      answer.mutable_welcome()->set_server_id(std::string(16, id));
      return {answer};
    }
    if (request.has_watch() || request.has_cancel()) asked.add(greeted.all().back());
    if (request.has_watch()) return {event(3), v1::Envelope()};
    if (request.has_cancel()) answer.mutable_job_summary()->set_job_id(7);
    if (request.has_list_jobs()) answer.mutable_job_list()->add_job()->set_job_id(7);
    if (request.has_ping()) answer.mutable_pong();
    return {answer};
  });
  server.beside([&](const std::string& address) {
    const JobHandle first{7, "61616161616161616161616161616161"};
    Recorded job(address, first);
    ASSERT_TRUE(job.done.wait([](const auto& all) { return all.size() == 1; }));
    ASSERT_FALSE(job.done.all()[0]);
    EXPECT_EQ(job.done.all()[0].error().kind, SessionError::Kind::input);

    Came<Answer<v1::JobSummary>> cancelled;
    Came<Answer<ServerJobs>> listed;
    job.hub.control(SessionHub::Order::cancel, first,
                    [&](Answer<v1::JobSummary> answer) { cancelled.add(std::move(answer)); });
    job.hub.list([&](Answer<ServerJobs> jobs) { listed.add(std::move(jobs)); });
    ASSERT_TRUE(listed.wait([](const auto& all) { return all.size() == 1; }));
    ASSERT_TRUE(cancelled.wait([](const auto& all) { return all.size() == 1; }));
    EXPECT_FALSE(cancelled.all()[0]);
    ASSERT_TRUE(listed.all()[0]);
    EXPECT_EQ(listed.all()[0]->server, "62626262626262626262626262626262");
    EXPECT_EQ(asked.all(), std::vector<char>{'a'});

    job.hub.control(SessionHub::Order::cancel, {7, listed.all()[0]->server},
                    [&](Answer<v1::JobSummary> answer) { cancelled.add(std::move(answer)); });
    ASSERT_TRUE(cancelled.wait([](const auto& all) { return all.size() == 2; }));
    EXPECT_TRUE(cancelled.all()[1]);
  });
}

TEST(SessionHub, AJobEndsForItWhereAnotherServerIsChosenBeforeTheSessionIsMadeAnew) {
  FakeServer server([&](const v1::Envelope& request) -> Envelopes {
    if (request.has_hello()) return {welcome()};
    return {v1::Envelope()};
  });
  server.beside([](const std::string& address) {
    Recorded job(address);
    EXPECT_TRUE(
        job.statuses.wait([](const auto& all) { return is_last(all, LinkStatus::Kind::lost); }));
    job.hub.open("unix:/nobody/listens/here");
    ASSERT_TRUE(job.done.wait([](const auto& all) { return all.size() == 1; }));
    EXPECT_FALSE(job.done.all()[0]);
  });
}

TEST(SessionHub, SaysWhileAnAnswerIsDueThatItsServerIsSlow) {
  std::latch said(1);
  FakeServer server([&](const v1::Envelope& request) -> Envelopes {
    v1::Envelope pong;
    pong.mutable_pong();
    if (request.has_hello()) return {welcome()};
    said.wait();
    return {pong};
  });
  server.beside([&](const std::string& address) {
    Came<LinkStatus> statuses;
    SessionHub hub([&](const LinkStatus& status) { statuses.add(status); });
    hub.open(address);
    const auto is_slow = [](const LinkStatus& one) { return one.slow > 0; };
    EXPECT_TRUE(statuses.wait([&](const auto& all) { return std::ranges::any_of(all, is_slow); }));
    const auto all = statuses.all();
    said.count_down();
    ASSERT_TRUE(is_slow(all.back()));
    EXPECT_EQ(all.back().slow, slow_answer) << "before the answer came";
    EXPECT_EQ(all.back().kind, LinkStatus::Kind::ready);
    EXPECT_TRUE(statuses.wait([](const auto& all) { return all.back().slow != slow_answer; }))
        << "what the answer took";
  });
}

TEST(SessionHub, IsLeftWhileItConnectsAndTriesAgainWhenItIsTold) {
  std::atomic<bool> greets = false;
  FakeServer server([&](const v1::Envelope& request) -> Envelopes {
    if (request.has_hello() && greets) return {welcome()};
    if (request.has_hello()) return {};
    v1::Envelope pong;
    pong.mutable_pong();
    return {pong};
  });
  server.beside([&](const std::string& address) {
    Came<LinkStatus> statuses;
    SessionHub hub([&](const LinkStatus& status) { statuses.add(status); });
    hub.open(address);
    EXPECT_TRUE(
        statuses.wait([](const auto& all) { return is_last(all, LinkStatus::Kind::connecting); }));
    hub.stop();
    EXPECT_TRUE(
        statuses.wait([](const auto& all) { return is_last(all, LinkStatus::Kind::lost); }));
    EXPECT_LT(statuses.all().back().retry_in, 0);
  });
  greets = true;
  FakeServer other([&](const v1::Envelope& request) -> Envelopes {
    v1::Envelope pong;
    pong.mutable_pong();
    return {request.has_hello() ? welcome() : pong};
  });
  other.beside([&](const std::string& address) {
    Came<LinkStatus> statuses;
    SessionHub hub([&](const LinkStatus& status) { statuses.add(status); });
    hub.open(address);
    EXPECT_TRUE(
        statuses.wait([](const auto& all) { return is_last(all, LinkStatus::Kind::ready); }));
    hub.stop();
    EXPECT_TRUE(
        statuses.wait([](const auto& all) { return is_last(all, LinkStatus::Kind::lost); }));
    hub.retry_now();
    EXPECT_TRUE(
        statuses.wait([](const auto& all) { return is_last(all, LinkStatus::Kind::ready); }));
  });
}

}  // namespace
}  // namespace metamer::test
