// How pictures are looked at is the same for all pictures of a window.
#include "client/gui/picture/picture_bar.h"

#include <QVBoxLayout>

#include "tests/client/gui/command_line.h"
#include "tests/client/gui/opened_scene.h"

namespace metamer::gui {
namespace {

class PlainPage : public PicturePage {
 public:
  explicit PlainPage(QObject* subject, int side = 8) : canvas_(new Canvas(this)) {
    (new QVBoxLayout(this))->addWidget(canvas_);
    setFocusProxy(canvas_);
    set_subject(subject);
    auto image = std::make_shared<Image>(make_image(side, side, {"X", "Y", "Z"}));
    for (float& value : image->pixels) value = 0.25F;
    canvas_->set_picture({image});
  }
  Canvas& canvas() override { return *canvas_; }

 private:
  Canvas* canvas_;
};

class PictureBarTest : public OpenedScene {
 protected:
  void SetUp() override {
    OpenedScene::SetUp();
    open(sound);
  }
  PlainPage* show_page(const QString& title, QObject* subject, int side = 8) {
    auto* page = new PlainPage(subject, side);
    window.show_picture(page, title);
    return page;
  }
  PictureBar* bar() { return window.findChild<PictureBar*>(); }
};

TEST_F(PictureBarTest, ThreeKeysAreAStopForPicturesThatAreThereAndForThoseThatCome) {
  PlainPage* first = show_page(QStringLiteral("first"), nullptr);
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
  first->setFocus();
  for (int i = 0; i < 3; ++i) QTest::keyClick(&first->canvas(), Qt::Key_E);
  EXPECT_DOUBLE_EQ(bar()->viewing().stops, 1);
  EXPECT_EQ(first->canvas().viewing().stops, 1);
  EXPECT_TRUE(first->canvas().wants_xyz());
  PlainPage* second = show_page(QStringLiteral("second"), nullptr);
  EXPECT_EQ(second->canvas().viewing().stops, 1);
  second->setFocus();
  for (int i = 0; i < 3; ++i) QTest::keyClick(&second->canvas(), Qt::Key_E, Qt::ShiftModifier);
  EXPECT_DOUBLE_EQ(bar()->viewing().stops, 0);
  EXPECT_EQ(first->canvas().viewing().stops, 0);
}

TEST_F(PictureBarTest, GIsTheMarkOfWhatIsOutOfGamutWithTheirNumberInTheCorner) {
  PlainPage* page = show_page(QStringLiteral("page"), nullptr);
  action("view.gamut")->trigger();
  EXPECT_TRUE(page->canvas().viewing().gamut);
  ASSERT_TRUE(wait([&] { return page->canvas().layer()->outside().has_value(); }));
  EXPECT_EQ(*page->canvas().layer()->outside(), 0U);
  bar()->set_stops(3);
  ASSERT_TRUE(wait([&] { return page->canvas().layer()->outside().has_value(); }));
  EXPECT_EQ(*page->canvas().layer()->outside(), 64U);
  action("view.gamut")->trigger();
  EXPECT_FALSE(page->canvas().layer()->outside());
}

TEST_F(PictureBarTest, NumbersStandInPixelsFrom32TimesOn) {
  PlainPage* page = show_page(QStringLiteral("page"), nullptr);
  window.show();
  const auto seen = [&](double zoom, bool numbers) {
    action("view.numbers")->setChecked(numbers);
    page->canvas().set_view({.fitted = false, .zoom = zoom, .centre = {4, 4}});
    return page->canvas().grab().toImage();
  };
  EXPECT_NE(seen(Canvas::numbers_from, true), seen(Canvas::numbers_from, false));
  EXPECT_EQ(seen(Canvas::numbers_from - 1, true), seen(Canvas::numbers_from - 1, false));
  page->canvas().set_view({.fitted = false, .zoom = 48, .centre = {4, 4}});
  take_shot(page->canvas(), QStringLiteral("numbers"));
  EXPECT_EQ(page->canvas().layer()->numbers({1, 1})[0], QStringLiteral("0.25"));
}

TEST_F(PictureBarTest, JFlicksThroughThePicturesOfOneSceneWithTheViewThatThereIs) {
  QObject other;
  QObject* scene = window.document();
  PlainPage* first = show_page(QStringLiteral("first"), scene);
  show_page(QStringLiteral("of another"), &other);
  PlainPage* second = show_page(QStringLiteral("second"), scene);
  PlainPage* larger = show_page(QStringLiteral("larger"), scene, 16);
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
  const auto press = [&](Qt::KeyboardModifiers modifiers) {
    window.picture_page()->setFocus();
    QTest::keyClick(&window.picture_page()->canvas(), Qt::Key_J, modifiers);
    return window.picture_page();
  };
  EXPECT_EQ(press({}), first) << "round the end; the live page has no picture yet";
  first->canvas().set_view({.fitted = false, .zoom = 5, .centre = {2, 3}});
  EXPECT_EQ(press({}), second);
  EXPECT_EQ(second->canvas().view().zoom, 5);
  EXPECT_EQ(second->canvas().view().centre, QPointF(2, 3));
  EXPECT_EQ(press({}), larger);
  EXPECT_TRUE(larger->canvas().view().fitted) << "of another size: as it was";
  EXPECT_EQ(press(Qt::ShiftModifier), second);
}

}  // namespace
}  // namespace metamer::gui
