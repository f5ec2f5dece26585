// A window with a private metamerd, as a person has it.
#include <gtest/gtest.h>

#include <QSignalSpy>
#include <QtTest>

#include "client/gui/app/add_app.h"
#include "client/gui/app/main_window.h"
#include "client/gui/compare/compare_page.h"
#include "client/tools/pictures/planned_developing.h"
#include "client/tools/pictures/screen_pixels.h"

namespace metamer::gui {
namespace {

constexpr int patience = 30'000;  // ms, of a machine that does other things

/// A window on the booth, once its first frame is there.
class Live : public ::testing::Test {
 protected:
  void SetUp() override {
    link_.open({});
    window_.open(find_booth());
    ASSERT_NE(window_.live(), nullptr);
    window_.resize(700, 400);
    window_.show();
    ASSERT_TRUE(wait([this] { return window_.live()->frame() != nullptr; }));
  }
  static bool wait(const std::function<bool()>& holds) { return QTest::qWaitFor(holds, patience); }
  LivePage& live() { return *window_.live(); }
  Actions& actions() { return window_.actions(); }

  Link link_;
  MainWindow window_{link_};
};

TEST_F(Live, TheFirstRunShowsTheBooth) {
  EXPECT_TRUE(wait([&] { return live().frame()->frame.complete(); }));
  EXPECT_GT(live().canvas().image().width(), 100);
  // The middle of the booth is lit.
  const QImage& image = live().canvas().image();
  EXPECT_GT(qGray(image.pixel(image.width() / 2, image.height() / 3)), 40);
}

TEST_F(Live, UnderAnExposureItIsDevelopedFromXyzOnceItIsComplete) {
  ASSERT_TRUE(wait([&] { return live().frame()->frame.complete(); }));
  const QImage before = live().canvas().image();
  actions()[QStringLiteral("view.brighter")]->trigger();
  ASSERT_TRUE(
      wait([&] { return qobject_cast<const XyzLayer*>(live().canvas().layer()) != nullptr; }));
  EXPECT_EQ(live().canvas().image(), before) << "its own numbers, from floats";
  const QImage brighter = live().canvas().grab().toImage();
  actions()[QStringLiteral("view.darker")]->trigger();
  EXPECT_EQ(live().canvas().viewing().stops, 0);
  const QImage own = live().canvas().grab().toImage();
  const QPoint middle(own.width() / 2, own.height() / 3);
  EXPECT_GT(qGray(brighter.pixel(middle)), qGray(own.pixel(middle)));
}

/// A server sends the X Y Z of a frame once.
TEST_F(Live, AnExposureThatComesBackIsOfTheFrameThatWasThere) {
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(wait([&] { return live().frame()->frame.complete(); }));
    actions()[QStringLiteral("view.brighter")]->trigger();
    ASSERT_TRUE(
        wait([&] { return qobject_cast<const XyzLayer*>(live().canvas().layer()) != nullptr; }));
    actions()[QStringLiteral("view.darker")]->trigger();
  }
  actions()[QStringLiteral("view.orbit.left")]->trigger();
  ASSERT_TRUE(
      wait([&] { return qobject_cast<const ImageLayer*>(live().canvas().layer()) != nullptr; }));
  actions()[QStringLiteral("view.gamut")]->trigger();
  EXPECT_TRUE(wait([&] { return live().canvas().layer() && live().canvas().layer()->outside(); }));
}

TEST_F(Live, ADraggedCameraIsFollowedAndHomeBringsItBack) {
  ASSERT_TRUE(wait([&] { return live().frame()->frame.complete(); }));
  const QImage before = live().canvas().image();
  const v1::Camera home = live().camera();
  actions()[QStringLiteral("view.orbit.left")]->trigger();
  EXPECT_NE(live().camera().eye().x(), home.eye().x());
  ASSERT_TRUE(
      wait([&] { return live().frame()->frame.complete() && live().canvas().image() != before; }));
  actions()[QStringLiteral("view.home")]->trigger();
  EXPECT_EQ(live().camera().SerializeAsString(), home.SerializeAsString());
  EXPECT_TRUE(
      wait([&] { return live().frame()->frame.complete() && live().canvas().image() == before; }));
}

TEST_F(Live, WhatIsTypedIsShownAndAMistakeLeavesTheLastSoundPicture) {
  ASSERT_TRUE(wait([&] { return live().frame()->frame.complete(); }));
  Document& document = *window_.document();
  const QImage before = live().canvas().image();
  QString text = document.text();
  const QString sound = text;
  document.set_text(
      text.replace(QStringLiteral("material: \"tcs09\""), QStringLiteral("material: \"tsc09\"")));
  ASSERT_TRUE(wait([&] { return document.checked() && !document.checked()->sound(); }));
  EXPECT_NE(document.checked()->problems()[0].message.find("tcs09"), std::string::npos);
  QTest::qWait(200);
  EXPECT_EQ(live().canvas().image(), before);
  text = sound;
  document.set_text(
      text.replace(QStringLiteral("vertical_fov: 17.6"), QStringLiteral("vertical_fov: 30")));
  EXPECT_TRUE(
      wait([&] { return live().frame()->frame.complete() && live().canvas().image() != before; }));
}

TEST_F(Live, AServerThatIsKilledIsFoundAgainAndThePictureComesBack) {
  ASSERT_TRUE(wait([&] { return link_.ready(); }));
  QSignalSpy statuses(&link_, &Link::status_changed);
  link_.open(QStringLiteral("unix:/nobody/listens/here"));
  ASSERT_TRUE(wait([&] { return link_.status().kind == client::LinkStatus::Kind::lost; }));
  EXPECT_FALSE(live().canvas().image().isNull());  // the old one stays
  link_.open({});
  const auto old = live().frame();
  EXPECT_TRUE(wait([&] { return live().frame() != old; }));
}

TEST_F(Live, HandsOverTheXyzOfWhatIsSeen) {
  std::optional<Picture> given;
  live().hand_over([&](const Picture& picture) { given = picture; });
  ASSERT_TRUE(wait([&] { return given.has_value(); }));
  const QImage& seen = live().canvas().image();
  ASSERT_EQ(QSize(given->xyz->width, given->xyz->height), seen.size());
  const client::ScreenPixels pixels(client::planned_developing(*given->plan)->developing);
  std::vector<std::uint32_t> row(static_cast<std::size_t>(seen.width()));
  for (int y = 0; y < seen.height(); ++y) {
    pixels.develop(given->xyz->at(0, y), row.size(), 1, row.data());
    for (int x = 0; x < seen.width(); ++x)
      ASSERT_EQ(row[static_cast<std::size_t>(x)], seen.pixel(x, y)) << x << ", " << y;
  }
}

TEST_F(Live, TwoFramesAreCompared) {
  actions()[QStringLiteral("compare.pictures")]->trigger();
  auto* page = window_.findChild<ComparePage*>();
  ASSERT_NE(page, nullptr);
  EXPECT_EQ(window_.pictures().currentWidget(), page);
  const PictureAtHand frame{live().picture_title(),
                            [this](auto to) { live().hand_over(std::move(to)); }};
  page->slot_box(0).set_at_hand(frame);
  ASSERT_TRUE(wait([&] { return page->slot_box(0).source().has_value(); }));
  page->slot_box(1).set_at_hand(frame);
  ASSERT_TRUE(wait([&] { return page->comparison() != nullptr; })) << page->told().toStdString();
  EXPECT_EQ(page->comparison()->difference.statistics.maximum, 0) << "nothing has changed";
}

}  // namespace
}  // namespace metamer::gui
