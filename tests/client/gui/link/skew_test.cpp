// Servers that are not there, that are slow, or of another age than the window.
#include "client/gui/inspector/inspector.h"
#include "tests/client/gui/link/faulty_window.h"
#include "tests/client/gui/link/relay.h"

namespace metamer::gui {
namespace {

class Skew : public FaultyWindow {
 protected:
  void open(const Relay& relay) { link_.open(QString::fromStdString(relay.address())); }
};

TEST_F(Skew, AServerThatIsNotThereLeavesTheTextToBeWrittenAndAPrivateOneToBeHad) {
  link_.open(QStringLiteral("unix:/nobody/listens/here"));
  ASSERT_TRUE(wait([&] { return bar_says(QStringLiteral("trying again in")); }));
  EXPECT_TRUE(bar_says(QStringLiteral("can't connect to unix:/nobody/listens/here")))
      << bar().text().toStdString();
  EXPECT_NE(button(QStringLiteral("Now")), nullptr);
  EXPECT_NE(button(QStringLiteral("Other…")), nullptr);
  Document& document = *window_.document();
  document.set_text(document.text() + QStringLiteral("nonsense"));
  EXPECT_TRUE(wait([&] { return document.settled() && !document.checked()->sound(); }));
  ASSERT_NE(button(QStringLiteral("Private server")), nullptr);
  QTest::mouseClick(button(QStringLiteral("Private server")), Qt::LeftButton);
  EXPECT_TRUE(completes());
  EXPECT_TRUE(bar_goes());
}

TEST_F(Skew, AnAddressThatIsNoneIsNotTriedAgain) {
  link_.open(QStringLiteral("nowhere:at:all"));
  ASSERT_TRUE(wait([&] { return is_lost(); }));
  EXPECT_LT(link_.status().retry_in, 0);
  EXPECT_TRUE(wait([&] { return bar().isVisible(); }));
}

TEST_F(Skew, AConnectionThatTakesLongIsCountedAndCanBeCancelled) {
  Relay relay;
  relay.on_request = [](const v1::Envelope&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return std::optional<v1::Envelope>();
  };
  relay.delay = std::chrono::minutes(1);
  open(relay);
  ASSERT_TRUE(wait([&] { return bar_says(QStringLiteral("connecting to unix:")); }));
  const QString first = bar().text();
  EXPECT_TRUE(wait([&] { return bar().isVisible() && bar().text() != first; })) << "it counts";
  EXPECT_TRUE(bar_says(QStringLiteral("connecting to unix:"))) << bar().text().toStdString();
  ASSERT_NE(button(QStringLiteral("Cancel")), nullptr);
  QTest::mouseClick(button(QStringLiteral("Cancel")), Qt::LeftButton);
  ASSERT_TRUE(wait([&] { return is_lost(); }));
  EXPECT_TRUE(wait([&] { return bar_says(QStringLiteral("not connected")); }));
  EXPECT_NE(button(QStringLiteral("Try again")), nullptr);
}

TEST_F(Skew, AnotherVersionOfTheProtocolIsToldWithBothAndNotTriedAgain) {
  Relay relay;
  relay.on_request = [](const v1::Envelope&) {
    v1::Envelope answer;
    answer.mutable_welcome()->set_protocol_version(7);
    return std::optional(answer);
  };
  open(relay);
  ASSERT_TRUE(wait([&] { return bar_says(QStringLiteral("speaks version 7")); }));
  EXPECT_TRUE(bar_says(QStringLiteral("this program version 1"))) << bar().text().toStdString();
  QTest::qWait(1500);
  EXPECT_TRUE(is_lost());
  EXPECT_EQ(relay.count(v1::Envelope::kHello), 1);
  EXPECT_EQ(button(QStringLiteral("Now")), nullptr);
  EXPECT_EQ(button(QStringLiteral("Try again")), nullptr);
  EXPECT_NE(button(QStringLiteral("Private server")), nullptr);
  EXPECT_NE(button(QStringLiteral("Other…")), nullptr);
}

TEST_F(Skew, AServerThatDoesNotKnowProbesLeavesPinsGrey) {
  Relay relay;
  relay.on_request = [](const v1::Envelope& request) -> std::optional<v1::Envelope> {
    if (!request.has_probe()) return std::nullopt;
    v1::Envelope answer;
    answer.mutable_error()->set_code(v1::Error::UNKNOWN_MESSAGE);
    return answer;
  };
  open(relay);
  ASSERT_TRUE(completes());
  EXPECT_TRUE(action("light.pin")->isEnabled());
  QTest::mouseMove(&live().canvas(), live().canvas().rect().center());
  live().probe({10, 10}, 1);
  ASSERT_TRUE(wait([&] { return !action("light.pin")->isEnabled(); }));
  EXPECT_EQ(action("light.pin")->toolTip(), QStringLiteral("this server does not know Probe"));
  for (int i = 0; i < 20; ++i) {
    QTest::mouseMove(&live().canvas(), live().canvas().rect().center() + QPoint(i, 0));
    QTest::qWait(5);
  }
  EXPECT_LE(relay.count(v1::Envelope::kProbe), 2) << "it is not asked again";
  // The next server may know them.
  link_.open({});
  EXPECT_TRUE(wait([&] { return action("light.pin")->isEnabled(); }));
  EXPECT_NE(action("light.pin")->toolTip(), QStringLiteral("this server does not know Probe"));
}

TEST_F(Skew, ASlowServerIsToldAndSoIsTheAgeOfAFrame) {
  Relay relay;
  open(relay);
  ASSERT_TRUE(completes());
  EXPECT_TRUE(bar_goes());
  relay.delay = std::chrono::seconds(2);
  const auto before = live().frame();
  action("view.orbit.left")->trigger();
  EXPECT_TRUE(wait([&] {
    return live().canvas().accessibleDescription().contains(QStringLiteral("s old"));
  })) << live().canvas().accessibleDescription().toStdString();
  EXPECT_TRUE(wait([&] { return bar_says(QStringLiteral("is slow")); }));
  relay.delay = std::chrono::milliseconds(0);
  EXPECT_TRUE(completes(before));
  EXPECT_TRUE(wait(
      [&] { return !live().canvas().accessibleDescription().contains(QStringLiteral("s old")); }));
  EXPECT_TRUE(bar_goes());
}

TEST_F(Skew, TypingKeepsTheViewThatIsOpen) {
  Relay relay;
  open(relay);
  ASSERT_TRUE(completes());
  Document& document = *window_.document();
  const QString sound = document.text();
  const auto type = [&](const QString& text) {
    const QImage before = live().canvas().image();
    const auto frame = live().frame();
    document.set_text(text);
    EXPECT_TRUE(completes(frame)) << text.toStdString();
    EXPECT_NE(live().canvas().image(), before);
  };
  type(QString(sound).replace(QStringLiteral("vertical_fov: 17.6"),
                              QStringLiteral("vertical_fov: 30")));
  type(sound + QStringLiteral("object { name: \"more\" material: \"tcs09\" sphere { radius: 0.2 "
                              "center { y: 0.5 z: 0.5 } } }\n"));
  type(sound);
  EXPECT_EQ(relay.count(v1::Envelope::kOpenView), 1);
  EXPECT_GE(relay.count(v1::Envelope::kUpdateView), 3);
  EXPECT_EQ(relay.count(v1::Envelope::kCloseView), 0);
}

}  // namespace
}  // namespace metamer::gui
