// Quick fixes: Alt+Return in the text, the button in the dock.
#include <QAbstractButton>
#include <QFileDialog>
#include <QMessageBox>

#include "client/gui/problems/problems_dock.h"
#include "tests/client/gui/opened_scene.h"

namespace metamer::gui {
namespace {

class Fixes : public OpenedScene {
 protected:
  ProblemsDock& dock() { return *window.findChild<ProblemsDock*>(); }
  int rows() { return dock().table().rowCount(); }
  QString text() { return window.editor()->text(); }

  /// The dialog that asks for a file gets one.
  void choose(const QString& file) {
    ASSERT_TRUE(wait([&] { return window.findChild<QFileDialog*>() != nullptr; }));
    auto* dialog = window.findChild<QFileDialog*>();
    Q_EMIT dialog->fileSelected(file);
    dialog->reject();
    ASSERT_TRUE(wait([&] { return window.findChild<QFileDialog*>() == nullptr; }));
  }
};

TEST_F(Fixes, AMisspeltMaterialIsMendedByAltReturn) {
  const QByteArray right = QByteArray(sound).replace("\"red\"", "\"tcs09\"");
  open(right);
  window.show();
  const auto at = right.indexOf("tcs09\" sphere");
  window.editor()->go_to(5, static_cast<int>(at - right.lastIndexOf('\n', at)));
  for (int i = 0; i < 5; ++i) QTest::keyClick(&window.editor()->viewport(), Qt::Key_Delete);
  QTest::keyClicks(&window.editor()->viewport(), QStringLiteral("tsc09"));
  ASSERT_TRUE(wait([&] { return rows() == 1; }));

  window.editor()->setFocus();
  QTest::keyClick(&window.editor()->viewport(), Qt::Key_Return, Qt::AltModifier);
  EXPECT_EQ(text(), QString::fromUtf8(right));
  EXPECT_TRUE(wait([&] { return rows() == 0; }));
  // The caret stands behind the name and its quote; one step back is what was typed.
  EXPECT_EQ(window.editor()->column(), static_cast<int>(at - right.lastIndexOf('\n', at)) + 6);
  window.editor()->undo();
  EXPECT_TRUE(text().contains(QStringLiteral("\"tsc09\"")));
}

TEST_F(Fixes, TheButtonSetsTheNearestAllowed) {
  open(replaced("diffuseness: 1", "diffuseness: 1.5"));
  window.show();
  ASSERT_EQ(rows(), 1);
  const QModelIndex button = dock().table().index(0, ProblemTable::fix);
  EXPECT_EQ(button.data().toString(), QStringLiteral("Write 1"));
  QTest::mouseClick(dock().view().viewport(), Qt::LeftButton, {},
                    dock().view().visualRect(button).center());
  EXPECT_EQ(text(), QString::fromUtf8(sound));
}

TEST_F(Fixes, OfTwoOnALineTheNearerToTheCaret) {
  open(replaced("diffuseness: 1", "diffuseness: 2")
           .replace("\"red\" diffuse", "\"red\" mirror: 3 diffuse"));
  ASSERT_EQ(rows(), 2);
  window.editor()->go_to(4, 80);
  action("edit.fix")->trigger();
  EXPECT_TRUE(text().contains(QStringLiteral("mirror: 3 diffuse")));
  EXPECT_TRUE(text().contains(QStringLiteral("diffuseness: 1 ")));
}

TEST_F(Fixes, WhereNothingIsToMendTheTextStays) {
  open(sound);
  action("edit.fix")->trigger();
  EXPECT_EQ(text(), QString::fromUtf8(sound));
}

TEST_F(Fixes, AMissingFileIsLocatedInTheFolder) {
  QDir(folder.path()).mkdir(QStringLiteral("spectra"));
  QFile::rename(path(QStringLiteral("red.txt")), path(QStringLiteral("spectra/other.txt")));
  open(sound);
  ASSERT_EQ(rows(), 1);
  EXPECT_EQ(dock().table().index(0, ProblemTable::fix).data().toString(),
            QStringLiteral("Locate…"));
  dock().fix(0);
  choose(path(QStringLiteral("spectra/other.txt")));
  EXPECT_EQ(text(), QString::fromUtf8(replaced("red.txt", "spectra/other.txt")));
  EXPECT_TRUE(wait([&] { return rows() == 0; }));
}

TEST_F(Fixes, AMissingFileFromElsewhereIsCopiedIfThatIsAgreedTo) {
  QTemporaryDir elsewhere;
  QFile::rename(path(QStringLiteral("red.txt")), elsewhere.filePath(QStringLiteral("far.txt")));
  open(sound);
  for (const auto answer : {QMessageBox::Cancel, QMessageBox::Yes}) {
    dock().fix(0);
    choose(elsewhere.filePath(QStringLiteral("far.txt")));
    auto* question = window.findChild<QMessageBox*>();
    ASSERT_NE(question, nullptr);
    EXPECT_EQ(text(), QString::fromUtf8(sound));
    question->button(answer)->click();
    ASSERT_TRUE(wait([&] { return window.findChild<QMessageBox*>() == nullptr; }));
  }
  EXPECT_TRUE(wait([&] { return text() == QString::fromUtf8(replaced("red.txt", "far.txt")); }));
  EXPECT_TRUE(QFile::exists(path(QStringLiteral("far.txt"))));
  EXPECT_TRUE(wait([&] { return rows() == 0; }));
}

}  // namespace
}  // namespace metamer::gui
