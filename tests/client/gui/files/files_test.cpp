// What the File menu does, and what is done for texts that are open.
#include <QClipboard>
#include <QDropEvent>
#include <QMessageBox>
#include <QMimeData>
#include <QPushButton>
#include <QSettings>

#include "client/gui/compare/compare_page.h"
#include "client/gui/files/file_watch.h"
#include "client/gui/files/recent_files.h"
#include "client/gui/files/save_file.h"
#include "tests/client/gui/opened_scene.h"

namespace metamer::gui {
namespace {

class Files : public OpenedScene {
 protected:
  QString scene() const { return path(QStringLiteral("scene.txtpb")); }
  MessageBar* bar() { return window.editor()->findChild<MessageBar*>(); }

  void answer(const QString& text) {
    for (QPushButton* button : bar()->findChildren<QPushButton*>())
      if (button->text().remove(QLatin1Char('&')) == text) return button->click();
    FAIL() << text.toStdString();
  }

  /// Of a file with this name, as a person's mouse does it.
  void drop(QWidget& onto, const char* name) {
    write(QString::fromUtf8(name), sound);
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(path(QString::fromUtf8(name)))});
    QDragEnterEvent enter({5, 5}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&onto, &enter);
    EXPECT_TRUE(enter.isAccepted());
    QDropEvent drop({5, 5}, Qt::CopyAction, &data, Qt::LeftButton, Qt::NoModifier);
    QApplication::sendEvent(&onto, &drop);
  }

  /// The next box that waits for an answer gets this one.
  static void answer_next_box(QMessageBox::StandardButton button) {
    QTimer::singleShot(50, [button] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      ASSERT_NE(box, nullptr);
      box->button(button)->click();
    });
  }
};

TEST_F(Files, ANewSceneIsSound) {
  action("file.new")->trigger();
  ASSERT_TRUE(wait([&] { return window.document()->checked() != nullptr; }));
  EXPECT_TRUE(window.document()->checked()->sound());
  EXPECT_FALSE(window.document()->modified());
  EXPECT_TRUE(window.editor()->text().startsWith(QLatin1Char('#')));
}

TEST_F(Files, TypingBackWhatWasSavedLeavesNothingToSave) {
  open(sound);
  window.editor()->insert(QStringLiteral("#"));
  EXPECT_TRUE(window.document()->modified());
  window.editor()->undo();
  EXPECT_FALSE(window.document()->modified());
}

TEST_F(Files, ANewContentOnTheDiskIsTakenIfThatIsWanted) {
  open(sound);
  window.editor()->go_to(5, 3);
  write(QStringLiteral("scene.txtpb"), QByteArray(sound) + "# more\n");
  ASSERT_TRUE(wait([&] { return bar() != nullptr; }));
  EXPECT_EQ(window.editor()->text(), QString::fromUtf8(sound));
  answer(QStringLiteral("Reload"));
  EXPECT_TRUE(window.editor()->text().endsWith(QStringLiteral("# more\n")));
  EXPECT_FALSE(window.document()->modified());
  EXPECT_EQ(window.editor()->line(), 5);
  EXPECT_EQ(window.editor()->column(), 3);
  EXPECT_TRUE(wait([&] { return bar() == nullptr; }));
}

TEST_F(Files, AReloadCanBeUndone) {
  open(sound);
  window.editor()->insert(QStringLiteral("# mine\n"));
  const QString mine = window.editor()->text();
  write(QStringLiteral("scene.txtpb"), QByteArray(sound).replace("radius: 1", "radius: 2"));
  ASSERT_TRUE(wait([&] { return bar() != nullptr; }));
  answer(QStringLiteral("Reload"));
  EXPECT_FALSE(window.document()->modified());
  window.editor()->undo();
  EXPECT_EQ(window.editor()->text(), mine);
  EXPECT_TRUE(window.document()->modified());
  window.editor()->undo();
  EXPECT_EQ(window.editor()->text(), QString::fromUtf8(sound));
}

TEST_F(Files, AnOpenSceneIsShownAndNotOpenedTwice) {
  open(sound);
  action("file.new")->trigger();
  ASSERT_EQ(window.scenes().count(), 2);
  window.open(scene());
  EXPECT_EQ(window.scenes().count(), 2);
  EXPECT_EQ(window.document()->path(), scene());
}

TEST_F(Files, ANewContentOnTheDiskIsLeftIfThatIsWanted) {
  open(sound);
  // As programs save that write another file first.
  write(QStringLiteral("other"), "camera { }\n");
  ASSERT_EQ(std::rename(path(QStringLiteral("other")).toUtf8(), scene().toUtf8()), 0);
  ASSERT_TRUE(wait([&] { return bar() != nullptr; }));
  answer(QStringLiteral("Keep"));
  EXPECT_EQ(window.editor()->text(), QString::fromUtf8(sound));
  EXPECT_TRUE(window.document()->modified());
}

TEST_F(Files, OnesOwnSavingAsksNothing) {
  open(sound);
  window.editor()->insert(QStringLiteral("# x\n"));
  action("file.save")->trigger();
  EXPECT_FALSE(window.document()->modified());
  QTest::qWait(3 * DiskWatch::gathering.count());
  EXPECT_EQ(bar(), nullptr);
}

TEST_F(Files, ASceneWhoseFileHasGoneIsNotSaved) {
  open(sound);
  QFile::remove(scene());
  EXPECT_TRUE(wait([&] { return window.document()->modified(); }));
  action("file.save")->trigger();
  EXPECT_TRUE(QFile::exists(scene()));
  EXPECT_FALSE(window.document()->modified());
}

TEST_F(Files, AFileOfTheSceneThatChangesIsCheckedByItself) {
  open(sound);
  EXPECT_TRUE(window.document()->problems().empty());
  write(QStringLiteral("red.txt"), "400 0.1\n500 x\n");
  EXPECT_TRUE(wait([&] { return window.document()->problems().size() == 1; }));
  QFile::remove(path(QStringLiteral("red.txt")));
  EXPECT_TRUE(wait([&] {
    return window.document()->problems().size() == 1 &&
           !window.document()->problems()[0].was.empty();
  }));
  write(QStringLiteral("red.txt"), "400 0.1\n700 0.9\n");
  EXPECT_TRUE(wait([&] { return window.document()->problems().empty(); }));
}

TEST_F(Files, TenAreRemembered) {
  QSettings().remove(QStringLiteral("recent_files"));
  RecentFiles recent;
  for (int i = 0; i < 12; ++i) recent.add(QStringLiteral("/scenes/%1.txtpb").arg(i));
  recent.add(QStringLiteral("/scenes/5.txtpb"));
  EXPECT_EQ(recent.files().size(), RecentFiles::most);
  EXPECT_EQ(recent.files().front(), QStringLiteral("/scenes/5.txtpb"));
  EXPECT_EQ(recent.files().count(QStringLiteral("/scenes/5.txtpb")), 1);
  open(sound);
  EXPECT_EQ(recent.files().front(), scene());
  QMenu* menu = action("file.recent")->menu();
  Q_EMIT menu->aboutToShow();
  EXPECT_EQ(menu->actions().size(), RecentFiles::most);
  window.close_scene(0);
  menu->actions().front()->trigger();
  ASSERT_NE(window.document(), nullptr);
  EXPECT_EQ(window.document()->path(), scene());
}

TEST_F(Files, ADroppedSceneIsOpened) {
  drop(window, "scene.txtpb");
  ASSERT_EQ(window.scenes().count(), 1);
  EXPECT_EQ(window.editor()->text(), QString::fromUtf8(sound));
  drop(window.editor()->viewport(), "other.txtpb");
  EXPECT_EQ(window.scenes().count(), 2);
  EXPECT_EQ(window.editor()->text(), QString::fromUtf8(sound)) << "its name is no text";
  drop(window.live()->canvas(), "third.txtpb");
  EXPECT_EQ(window.scenes().count(), 3);
}

TEST_F(Files, APictureThatIsDroppedOntoAnotherIsCompared) {
  open(sound);
  drop(window.live()->canvas(), "b.png");
  EXPECT_EQ(window.scenes().count(), 1);
  auto* page = window.findChild<ComparePage*>();
  ASSERT_NE(page, nullptr);
  EXPECT_EQ(window.pictures().currentWidget(), page);
  ASSERT_TRUE(page->slot_box(0).source().has_value());
  EXPECT_EQ(page->slot_box(0).source()->file, path(QStringLiteral("b.png")));
}

TEST_F(Files, SavedInAnotherFolderTheFilesComeAlongIfThatIsWanted) {
  open(sound);
  QTemporaryDir elsewhere;
  const QString there = elsewhere.filePath(QStringLiteral("scene.txtpb"));
  answer_next_box(QMessageBox::Cancel);
  EXPECT_FALSE(save_to(&window, *window.document(), there));
  EXPECT_FALSE(QFile::exists(there));
  answer_next_box(QMessageBox::Yes);
  EXPECT_TRUE(save_to(&window, *window.document(), there));
  EXPECT_EQ(window.document()->path(), there);
  EXPECT_TRUE(wait([&] { return QFile::exists(elsewhere.filePath(QStringLiteral("red.txt"))); }));
  EXPECT_TRUE(wait([&] { return window.document()->problems().empty(); }));
}

}  // namespace
}  // namespace metamer::gui
