#include "client/session/hub.h"

#include <gtest/gtest.h>

#include <latch>
#include <thread>

#include "client/session/scene_change.h"
#include "hub_watching.h"

namespace metamer::test {
namespace {

TEST(RetryDelay, DoublesUpToHalfAMinute) {
  const std::vector<double> expected{1, 2, 4, 8, 16, 30, 30};
  for (unsigned i = 0; i < expected.size(); ++i) EXPECT_EQ(retry_delay(i), expected[i]);
  EXPECT_EQ(retry_delay(4'000'000'000u), 30);
}

TEST(SessionHub, SaysThatThereIsNoServer) {
  Came<LinkStatus> statuses;
  SessionHub hub([&](const LinkStatus& status) { statuses.add(status); });
  Came<bool> answers;
  hub.list([&](Answer<ServerJobs> list) { answers.add(list.has_value()); });
  EXPECT_TRUE(answers.wait([](const auto& all) { return all == std::vector<bool>{false}; }));
  hub.open("unix:/nobody/listens/here");
  EXPECT_TRUE(statuses.wait([](const auto& all) { return is_last(all, LinkStatus::Kind::lost); }));
  EXPECT_EQ(statuses.all().back().error.kind, SessionError::Kind::no_server);
  EXPECT_EQ(statuses.all().back().retry_in, 1);
}

TEST(SessionHub, DoesNotTryAgainWhereVersionsDiffer) {
  FakeServer server([](const v1::Envelope&) { return std::vector{welcome(7)}; });
  server.beside([](const std::string& address) {
    Came<LinkStatus> statuses;
    SessionHub hub([&](const LinkStatus& status) { statuses.add(status); });
    hub.open(address);
    EXPECT_TRUE(
        statuses.wait([](const auto& all) { return is_last(all, LinkStatus::Kind::lost); }));
    EXPECT_EQ(statuses.all().back().error.kind, SessionError::Kind::version);
    EXPECT_LT(statuses.all().back().retry_in, 0);
  });
}

TEST(SessionHub, ConnectsAgainWhereTheSessionIsLost) {
  int hellos = 0;
  FakeServer server([&](const v1::Envelope& request) {
    if (request.has_hello()) {
      ++hellos;
      return std::vector{welcome()};
    }
    return std::vector{v1::Envelope()};  // closes at the first ping
  });
  server.beside([](const std::string& address) {
    Came<LinkStatus> statuses;
    SessionHub hub([&](const LinkStatus& status) { statuses.add(status); });
    hub.open(address);
    EXPECT_TRUE(
        statuses.wait([](const auto& all) { return is_last(all, LinkStatus::Kind::lost); }));
    hub.retry_now();
    EXPECT_TRUE(statuses.wait([](const auto& all) {
      return std::ranges::count(all, LinkStatus::Kind::ready, &LinkStatus::kind) >= 2;
    }));
  });
  EXPECT_GE(hellos, 2);
}

TEST(SessionHub, EndsWhileItConnects) {
  FakeServer server(
      [](const v1::Envelope&) { return std::vector<v1::Envelope>(); });  // never greets
  server.beside([](const std::string& address) {
    SessionHub hub([](const LinkStatus&) {});
    hub.open(address);
  });
}

TEST(LiveView, AsksForNoMoreThanTwoFramesThatAreNotTaken) {
  ViewAnswers answers(1000);
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  server.beside([&](const std::string& address) {
    Watching watching(address);
    EXPECT_TRUE(watching.frames.wait([](const auto& all) { return all.size() == 2; }));
    watching.view->taken();
    EXPECT_TRUE(watching.frames.wait([](const auto& all) { return all.size() == 3; }));
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    EXPECT_EQ(watching.frames.all().size(), 3u);
    EXPECT_EQ(answers.asked.all().size(), 3u);
  });
}

TEST(LiveView, RestsOnceThePictureIsCompleteAndGoesOnAfterAChange) {
  ViewAnswers answers(1);
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  server.beside([&](const std::string& address) {
    Watching watching(address);
    EXPECT_TRUE(watching.frames.wait(
        [](const auto& all) { return !all.empty() && all.back().complete(); }));
    watching.take_each();
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const std::size_t before = answers.asked.all().size();
    EXPECT_LE(before, 2u);  // both were asked for before the first one came
    v1::UpdateView change;
    change.mutable_camera()->set_vertical_fov(20);
    watching.view->change(change);
    EXPECT_TRUE(watching.frames.wait([](const auto& all) { return all.back().revision() == 1; }));
  });
}

TEST(LiveView, XyzThatAreWantedComeThoughThatIsSaidTwiceAndAFrameWithoutThemWasUnderWay) {
  for (const bool at_rest : {false, true}) {
    ViewAnswers answers(1);
    FakeServer server([&](const v1::Envelope& request) { return answers(request); });
    server.beside([&](const std::string& address) {
      Watching watching(address);
      if (at_rest) {
        EXPECT_TRUE(watching.frames.wait(
            [](const auto& all) { return !all.empty() && all.back().complete(); }));
      }
      watching.take_each();
      watching.view->want_xyz(true);
      watching.view->want_xyz(true);
      EXPECT_TRUE(watching.xyz.wait([](const auto& all) { return !all.empty(); }));
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      EXPECT_LE(watching.xyz.all().size(), 2U) << "it rests: two were asked for at once";
    });
  }
}

TEST(LiveView, GathersChangesAndShowsTheNewest) {
  std::latch told(1);
  ViewAnswers answers(1);
  FakeServer server([&](const v1::Envelope& request) {
    if (request.has_update_view()) told.wait();
    return answers(request);
  });
  server.beside([&](const std::string& address) {
    Watching watching(address);
    watching.take_each();
    for (int i = 1; i <= 200; ++i) {
      v1::UpdateView change;
      change.mutable_camera()->set_vertical_fov(i * 0.5);
      watching.view->change(change);
    }
    told.count_down();
    EXPECT_TRUE(answers.changes.wait(
        [](const auto& all) { return !all.empty() && all.back().camera().vertical_fov() == 100; }));
    EXPECT_LE(answers.changes.all().size(), 2u) << "one was under way";
    for (const v1::UpdateView& change : answers.changes.all()) EXPECT_TRUE(change.has_camera());
  });
}

TEST(LiveView, GoesOnAfterARefusal) {
  ViewAnswers answers(3);
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  server.beside([&](const std::string& address) {
    Watching watching(address);
    EXPECT_TRUE(watching.frames.wait([](const auto& all) { return !all.empty(); }));
    answers.refuse = true;
    v1::UpdateView change;
    change.mutable_settings()->set_spp(1);
    watching.take_each();
    watching.view->change(change);
    EXPECT_TRUE(watching.refusals.wait([](const auto& all) { return all.size() == 1; }));
    v1::UpdateView again;
    again.mutable_settings()->set_spp(2);
    watching.view->change(again);
    EXPECT_TRUE(answers.changes.wait([](const auto& all) { return all.size() == 2; }));
    EXPECT_TRUE(watching.losses.all().empty());
  });
}

TEST(LiveView, ProbesOnePlaceAtATimeAndTheNewestNext) {
  std::latch told(1);
  ViewAnswers answers(1);
  FakeServer server([&](const v1::Envelope& request) {
    if (request.has_probe()) told.wait();
    return answers(request);
  });
  server.beside([&](const std::string& address) {
    Watching watching(address);
    for (std::uint32_t i = 1; i <= 100; ++i) watching.view->probe({.x = i, .y = 2, .side = 3});
    told.count_down();
    EXPECT_TRUE(watching.probed.wait(
        [](const auto& all) { return !all.empty() && all.back().first.x == 100; }));
    EXPECT_LE(answers.probes.all().size(), 2u) << "one was under way";
    for (const auto& [place, probed] : watching.probed.all()) {
      EXPECT_EQ(probed.xyz(0), place.x);
      EXPECT_EQ(probed.xyz(2), 3);
    }
    EXPECT_TRUE(watching.losses.all().empty());
  });
}

TEST(LiveView, GoesOnBesideAServerThatKnowsNoProbes) {
  ViewAnswers answers(1000);
  answers.knows_probes = false;
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  server.beside([&](const std::string& address) {
    Watching watching(address);
    watching.view->probe({});
    EXPECT_TRUE(watching.unprobed.wait([](const auto& all) { return all.size() == 1; }));
    EXPECT_EQ(watching.unprobed.all()[0].code, v1::Error::UNKNOWN_MESSAGE);
    EXPECT_TRUE(watching.frames.wait([](const auto& all) { return all.size() == 2; }));
    watching.view->taken();
    EXPECT_TRUE(watching.frames.wait([](const auto& all) { return all.size() >= 3; }));
    EXPECT_TRUE(watching.losses.all().empty());
  });
}

TEST(LiveView, ClosesThoughAProbeIsNeverAnswered) {
  ViewAnswers answers(1);
  answers.hold_probes = true;
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  server.beside([&](const std::string& address) {
    Watching watching(address);
    watching.view->probe({});
    EXPECT_TRUE(answers.probes.wait([](const auto& all) { return all.size() == 1; }));
    watching.view.reset();
    EXPECT_TRUE(answers.closed.wait([](const auto& all) { return all.size() == 1; }));
  });
}

TEST(LiveView, SaysThatItIsLostWithTheSessionThoughItRests) {
  ViewAnswers answers(1);
  std::atomic<bool> gone = false;
  FakeServer server([&](const v1::Envelope& request) {
    return gone ? std::vector{v1::Envelope()} : answers(request);
  });
  server.beside([&](const std::string& address) {
    Watching watching(address);
    EXPECT_TRUE(watching.frames.wait(
        [](const auto& all) { return !all.empty() && all.back().complete(); }));
    gone = true;  // at the next beat
    EXPECT_TRUE(watching.losses.wait([](const auto& all) { return all.size() == 1; }));
    watching.view->taken();
    EXPECT_EQ(watching.losses.all().size(), 1u);
  });
}

TEST(LiveView, ClosesOnTheServerWhenItsOwnerLetsGo) {
  ViewAnswers answers(1000);
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  server.beside([&](const std::string& address) {
    Watching watching(address);
    EXPECT_TRUE(watching.frames.wait([](const auto& all) { return all.size() == 2; }));
    watching.view.reset();
    EXPECT_TRUE(answers.closed.wait([](const auto& all) { return all.size() == 1; }));
    EXPECT_TRUE(watching.losses.all().empty());
  });
}

TEST(LiveView, OutlivesItsHub) {
  ViewAnswers answers(1000);
  FakeServer server([&](const v1::Envelope& request) { return answers(request); });
  server.beside([&](const std::string& address) {
    std::shared_ptr<HubView> view;
    {
      Watching watching(address);
      view = watching.view;
    }
    view->taken();
    view->change(v1::UpdateView());
  });
}

TEST(MergedChanges, KeepTheNewestOfEachName) {
  v1::UpdateView older, newer;
  older.add_light()->set_name("left");
  older.mutable_light(0)->set_luminance(1);
  older.add_light()->set_name("right");
  newer.add_light()->set_name("left");
  newer.mutable_light(0)->set_luminance(2);
  newer.add_material()->set_name("paint");
  merge(newer, older);
  ASSERT_EQ(older.light_size(), 2);
  EXPECT_EQ(older.light(0).luminance(), 2);
  EXPECT_EQ(older.material_size(), 1);
}

}  // namespace
}  // namespace metamer::test
