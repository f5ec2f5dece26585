// With the keyboard alone and no book: a scene of one's own, which of two paints matches, the sheet
// and the final picture in files.
#include <QApplication>
#include <QFileDialog>
#include <QPushButton>

#include "client/gui/jobs/job_page.h"
#include "client/gui/sheet/sheet_page.h"
#include "tests/client/gui/jobs/jobs_window.h"
#include "tests/client/gui/opened_scene.h"

namespace metamer::gui {
namespace {

class Newcomer : public OpenedScene {
 protected:
  static constexpr int patience = 60'000;  // ms

  void SetUp() override {
    OpenedScene::SetUp();
    QByteArray scene =
        QByteArray::fromStdString(metamer::test::blink_scene("width: 60 height: 40 spp: 1"));
    scene +=
        "material { name: \"near\" diffuse { samples { wavelength: 400 wavelength: 700 "
        "value: 0.79 value: 0.1 } } diffuseness: 1 }\n"
        "material { name: \"far\" diffuse { samples { wavelength: 400 wavelength: 550 "
        "wavelength: 700 value: 0.8 value: 0.2 value: 0.3 } } diffuseness: 1 }\n";
    write(QStringLiteral("own.txtpb"), scene);
    link.open({});
    window.resize(1200, 800);
    window.show();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
    ASSERT_TRUE(waits([&] { return link.ready(); }));
  }

  static bool waits(const std::function<bool()>& holds) { return QTest::qWaitFor(holds, patience); }
  static QWidget* focus() {
    QWidget* at = QApplication::focusWidget();
    return at == nullptr ? QApplication::activeWindow() : at;
  }
  static void press(int key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    ASSERT_NE(focus(), nullptr);
    QTest::keyClick(focus(), static_cast<Qt::Key>(key), modifiers);
  }
  static void type(const QString& text) {
    ASSERT_NE(focus(), nullptr);
    press(Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(focus(), text);
  }

  /// Presses what opens a dialog for a file, and types its name there; the dialog has a loop of its
  /// own.
  void name_file(const QString& path, int key, Qt::KeyboardModifiers modifiers) {
    bool typed = false;
    QTimer look;
    QObject::connect(&look, &QTimer::timeout, &window, [&] {
      auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      if (dialog == nullptr || QApplication::activeWindow() != dialog) return;
      look.stop();
      type(path);
      press(Qt::Key_Return);
      typed = true;
    });
    look.start(50);
    press(key, modifiers);
    EXPECT_TRUE(waits([&] { return typed; })) << "no dialog asks for a file";
    // A desktop gives it back by itself.
    window.activateWindow();
    EXPECT_TRUE(QTest::qWaitForWindowActive(&window));
  }

  static bool is_png(const QString& path) {
    return waits([&] { return !QImage(path).isNull(); });
  }
};

TEST_F(Newcomer, FindsWhichOfTwoPaintsMatchesAndSavesSheetAndPicture) {
  name_file(path(QStringLiteral("own.txtpb")), Qt::Key_O, Qt::ControlModifier);
  ASSERT_TRUE(waits([&] { return window.document() != nullptr && window.document()->sound(); }));

  // Which paint is like the ball's: the sheet has the focus where paints are chosen.
  press(Qt::Key_T, Qt::ControlModifier | Qt::ShiftModifier);
  auto* sheet = qobject_cast<SheetPage*>(window.picture_page());
  ASSERT_NE(sheet, nullptr);
  ASSERT_TRUE(waits([&] { return sheet->sheet() != nullptr; }));
  ASSERT_TRUE(sheet->isAncestorOf(QApplication::focusWidget()));
  for (const char* paint : {"ball", "near", "far"}) {
    type(QString::fromUtf8(paint));
    press(Qt::Key_Tab);
  }
  const auto before = sheet->sheet();
  press(Qt::Key_M, Qt::AltModifier);
  ASSERT_TRUE(waits([&] { return sheet->sheet() != before; }));
  EXPECT_EQ(sheet->sheet()->wish.lights.size(), 3);
  EXPECT_TRUE(sheet->verdict().startsWith(QStringLiteral("near is nearer to ball")))
      << sheet->verdict().toStdString();

  // Whatever is in front is saved by the same key.
  name_file(path(QStringLiteral("sheet.png")), Qt::Key_E, Qt::ControlModifier);
  EXPECT_TRUE(is_png(path(QStringLiteral("sheet.png"))));

  press(Qt::Key_F9);
  ASSERT_TRUE(waits([&] { return qobject_cast<JobPage*>(window.picture_page()) != nullptr; }));
  ASSERT_TRUE(waits([&] { return window.picture_page()->picture().has_value(); }));
  name_file(path(QStringLiteral("final.png")), Qt::Key_E, Qt::ControlModifier);
  ASSERT_TRUE(is_png(path(QStringLiteral("final.png"))));
  EXPECT_EQ(QImage(path(QStringLiteral("final.png"))).size(), QSize(60, 40));
}

TEST_F(Newcomer, ComesIntoEveryPaneByF6) {
  name_file(path(QStringLiteral("own.txtpb")), Qt::Key_O, Qt::ControlModifier);
  ASSERT_TRUE(waits([&] { return window.document() != nullptr && window.document()->sound(); }));
  for (const char* id : {"compare.pictures", "compare.sheet", "help.models", "help.keys"}) {
    action(id)->trigger();
    QWidget* page = window.pictures().currentWidget();
    bool came = false;
    for (int i = 0; i < 8 && !came; ++i) {
      press(Qt::Key_F6);
      came = page == QApplication::focusWidget() || page->isAncestorOf(QApplication::focusWidget());
    }
    EXPECT_TRUE(came) << id;
  }
}

}  // namespace
}  // namespace metamer::gui
