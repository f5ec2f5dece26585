// What a window does when its server, or what draws for it, is lost.
#include "client/gui/jobs/job_page.h"
#include "client/gui/jobs/render_scene.h"
#include "tests/client/gui/link/faulty_window.h"
#include "tests/client/gui/link/processes.h"
#include "tests/client/gui/link/relay.h"

namespace metamer::gui {
namespace {

using Body = v1::Envelope::BodyCase;

class Loss : public FaultyWindow {
 protected:
  static pid_t private_server() {
    const auto found = children_named(getpid(), "metamerd");
    return found.size() == 1 ? *found.begin() : -1;
  }
  /// Kills it, and whether that was seen. The next one may be there before this looks.
  bool loses(pid_t server) {
    bool was_lost = false;
    const auto seen =
        QObject::connect(&link_, &Link::status_changed, &window_, [&] { was_lost |= is_lost(); });
    kill(server, SIGKILL);
    const bool said = wait([&] { return was_lost; });
    QObject::disconnect(seen);
    return said;
  }
  void open_private() {
    link_.open({});
    ASSERT_TRUE(completes());
  }
};

TEST_F(Loss, APrivateServerThatIsKilledIsStartedAnewAndTheViewComesBackWithItsLook) {
  open_private();
  const QImage day = live().canvas().image();
  ASSERT_TRUE(completes_after("light.look.2"));
  const QImage lit = live().canvas().image();
  ASSERT_NE(lit, day);
  const auto shown = live().frame();
  const pid_t server = private_server();
  ASSERT_GT(server, 0);
  ASSERT_TRUE(loses(server));
  ASSERT_TRUE(wait([&] { return link_.ready(); }));
  EXPECT_EQ(live().canvas().image().size(), lit.size()) << "the picture stays meanwhile";
  ASSERT_TRUE(completes(shown));
  EXPECT_EQ(live().canvas().image(), lit);
  EXPECT_TRUE(bar_goes());
}

TEST_F(Loss, AfterThreeTimesInAMinuteThereAreItsLastWordsAndTryAgain) {
  link_.open({});
  for (int i = 0; i < 4; ++i) {
    ASSERT_TRUE(wait([&] { return link_.ready() && private_server() > 0; })) << i;
    ASSERT_TRUE(loses(private_server())) << i;
  }
  ASSERT_TRUE(wait([&] { return is_lost() && link_.status().retry_in < 0; }));
  EXPECT_TRUE(bar_says(QStringLiteral("the private metamerd ended by signal 9")))
      << bar().text().toStdString();
  QTest::qWait(300);
  EXPECT_TRUE(is_lost()) << "it is left alone";
  EXPECT_EQ(button(QStringLiteral("Private server")), nullptr) << "that is Try again";
  ASSERT_NE(button(QStringLiteral("Try again")), nullptr);
  QTest::mouseClick(button(QStringLiteral("Try again")), Qt::LeftButton);
  EXPECT_TRUE(completes());
  EXPECT_TRUE(bar_goes());
}

TEST_F(Loss, AWorkerThatIsKilledIsMadeGoodByItself) {
  open_private();
  ASSERT_TRUE(completes_after("light.look.2"));
  const QImage lit = live().canvas().image();
  const auto before = live().frame();
  const pid_t server = private_server();
  ASSERT_GT(kill_children(server, "metamer-worker"), 0U);
  ASSERT_TRUE(completes(before)) << "nothing was touched";
  EXPECT_EQ(live().canvas().image(), lit);
  EXPECT_EQ(private_server(), server);
  EXPECT_TRUE(link_.ready());
}

TEST_F(Loss, AViewIsLostInTheMiddleOfAFrameAndComesBack) {
  Relay relay;
  std::atomic<bool> cut = false;
  relay.on_answer = [&](const v1::Envelope& answer) {
    const v1::ViewEvent& event = answer.view_event();
    return !(cut && event.has_band() && event.band().first_row() > 0 && cut.exchange(false));
  };
  // So large that its frames are several bands.
  window_.resize(1000, 640);
  link_.open(QString::fromStdString(relay.address()));
  ASSERT_TRUE(completes());
  const QImage before = live().canvas().image();
  relay.refuses = true;
  cut = true;
  action("view.orbit.left")->trigger();
  ASSERT_TRUE(wait([&] { return is_lost(); }));
  ASSERT_TRUE(wait([&] {
    return bar_says(QStringLiteral("lost the connection to unix:")) &&
           bar_says(QStringLiteral("trying again in"));
  }));
  EXPECT_FALSE(live().canvas().image().isNull());
  EXPECT_TRUE(live().canvas().stale().startsWith(QStringLiteral("old: ")));
  relay.refuses = false;
  ASSERT_NE(button(QStringLiteral("Now")), nullptr);
  QTest::mouseClick(button(QStringLiteral("Now")), Qt::LeftButton);
  ASSERT_TRUE(completes());
  EXPECT_NE(live().canvas().image(), before) << "as it was turned";
  EXPECT_TRUE(bar_goes());
}

TEST_F(Loss, AJobsPageGoesOnAtTheNextEventAndItsPictureIsWhole) {
  Relay relay;
  Relay* const to = &relay;
  std::atomic<int> tiles = 0;
  std::atomic<std::uint64_t> last = 0, from = 0;
  relay.on_request = [&](const v1::Envelope& request) -> std::optional<v1::Envelope> {
    if (request.has_watch()) from = request.watch().from_sequence();
    return std::nullopt;
  };
  relay.on_answer = [&](const v1::Envelope& answer) {
    if (answer.job_event().has_tile() && ++tiles == 3) {
      to->refuses = true;
      return false;
    }
    if (answer.has_job_event() && tiles < 3) last = answer.job_event().sequence();
    return true;
  };
  live().set_live(false);
  link_.open(QString::fromStdString(relay.address()));
  ASSERT_TRUE(wait([&] { return link_.ready(); }));
  // So small that a machine with much else to do ends it in time.
  auto scene = std::make_shared<v1::Scene>(*window_.document()->effective());
  scene->mutable_settings()->set_width(96);
  scene->mutable_settings()->set_height(64);
  scene->mutable_settings()->set_tile_size(16);
  scene->mutable_settings()->set_spp(1);
  JobPage* page = render_scene(window_, scene, window_.document()->sound()->assets(), {});
  ASSERT_NE(page, nullptr);
  ASSERT_TRUE(wait([&] { return is_lost() && !page->canvas().stale().isEmpty(); }));
  EXPECT_FALSE(page->panel().ended());
  relay.refuses = false;
  link_.retry_now();
  ASSERT_TRUE(wait([&] { return page->picture().has_value(); }));
  EXPECT_TRUE(page->canvas().stale().isEmpty());
  EXPECT_GT(from, 1U) << "not from the beginning";
  EXPECT_LE(from, last + 1);
  EXPECT_EQ(page->picture()->xyz->width, static_cast<int>(page->picture()->plan->width()));
}

TEST_F(Loss, AJobOfAPrivateServerThatIsKilledEndsWithIt) {
  link_.open({});
  ASSERT_TRUE(wait([&] { return link_.ready() && private_server() > 0; }));
  auto scene = std::make_shared<v1::Scene>(*window_.document()->effective());
  scene->mutable_settings()->set_width(4096);
  scene->mutable_settings()->set_height(4096);
  JobPage* page = render_scene(window_, scene, window_.document()->sound()->assets(), {});
  ASSERT_TRUE(wait([&] { return page->title().contains(QLatin1Char('%')); }));
  kill(private_server(), SIGKILL);
  ASSERT_TRUE(wait([&] { return page->panel().ended(); }));
  EXPECT_TRUE(
      page->canvas().stale().contains(QStringLiteral("the job ended with the server that had it")))
      << page->canvas().stale().toStdString();
}

}  // namespace
}  // namespace metamer::gui
