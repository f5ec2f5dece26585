// Looks in a live view, with a private metamerd.
#include <QtTest>

#include "client/gui/compare/compare_page.h"
#include "client/gui/looks/spectrum_drop.h"
#include "tests/client/gui/looks/looked_scene.h"

namespace metamer::gui {
namespace {

class LiveLooks : public LookedScene {
 protected:
  void SetUp() override {
    LookedScene::SetUp();
    link.open({});
    open(QByteArray(without_looks) + looks);
    window.resize(700, 400);
    window.show();
    ASSERT_TRUE(settled()) << "no first picture";
  }

  bool settled() {
    return QTest::qWaitFor([&] { return live().frame() && live().frame()->frame.complete(); },
                           30'000);
  }
  /// Whether another picture comes, and is complete.
  bool becomes_other(const QImage& before) {
    return QTest::qWaitFor(
        [&] { return live().frame()->frame.complete() && live().canvas().image() != before; },
        30'000);
  }
  LivePage& live() { return *window.live(); }
};

TEST_F(LiveLooks, TheViewFollowsALookAndItsUndo) {
  const QImage before = live().canvas().image();
  action(QStringLiteral("light.look.2"))->trigger();
  ASSERT_TRUE(becomes_other(before));
  const QImage lit = live().canvas().image();
  // A is redder than D65.
  const QRgb middle = lit.pixel(lit.width() / 2, lit.height() / 2);
  const QRgb was = before.pixel(before.width() / 2, before.height() / 2);
  EXPECT_GT(qRed(middle) * qBlue(was), qRed(was) * qBlue(middle));
  window.document()->undo().undo();
  ASSERT_TRUE(becomes_other(lit));
  EXPECT_EQ(live().canvas().image(), before);
}

TEST_F(LiveLooks, APaintThatIsDroppedOntoAnObjectBecomesItsMaterials) {
  const QImage before = live().canvas().image();
  const std::string own = effective();
  auto* drop = window.findChild<SpectrumDrop*>();
  drop->drop(QStringLiteral("TCS12"), QPoint(before.width() / 2, before.height() / 2));
  ASSERT_TRUE(becomes_other(before));
  const v1::Material painted = window.document()->effective()->material(0);
  EXPECT_GT(painted.diffuse().samples().value_size(), 10);
  EXPECT_EQ(window.document()->undo().count(), 1);
  window.document()->undo().undo();
  EXPECT_EQ(effective(), own);
}

TEST_F(LiveLooks, WhileRIsHeldTheViewIsByRgb) {
  live().canvas().setFocus();
  QTest::keyPress(&live().canvas(), Qt::Key_R);
  EXPECT_TRUE(QTest::qWaitFor([&] { return live().frame()->plan.method().has_rgb(); }, 30'000));
  QTest::keyRelease(&live().canvas(), Qt::Key_R);
  EXPECT_TRUE(QTest::qWaitFor([&] { return !live().frame()->plan.method().has_rgb(); }, 30'000));
  EXPECT_EQ(window.document()->undo().count(), 0);
}

TEST_F(LiveLooks, TheMapOfBothIsInTheComparePage) {
  action(QStringLiteral("light.look.2"))->trigger();
  action(QStringLiteral("light.rgb_map"))->trigger();
  auto* page = [&]() -> ComparePage* {
    EXPECT_TRUE(QTest::qWaitFor(
        [&] { return qobject_cast<ComparePage*>(window.picture_page()) != nullptr; }, 30'000));
    return qobject_cast<ComparePage*>(window.picture_page());
  }();
  ASSERT_NE(page, nullptr);
  ASSERT_TRUE(page->slot_box(0).source() && page->slot_box(1).source());
  EXPECT_FALSE(page->slot_box(0).source()->picture->plan->method().has_rgb());
  EXPECT_TRUE(page->slot_box(1).source()->picture->plan->method().has_rgb());
}

}  // namespace
}  // namespace metamer::gui
