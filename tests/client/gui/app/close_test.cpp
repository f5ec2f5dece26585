// A tab that is closed with changes: what is asked, and which file is written.
#include <QApplication>
#include <QMessageBox>
#include <QPushButton>
#include <QTimer>

#include "client/gui/editor/scene_editor.h"
#include "tests/client/gui/opened_scene.h"

namespace metamer::gui {
namespace {

class Close : public OpenedScene {
 protected:
  static void answer(QMessageBox::StandardButton button) {
    QTimer::singleShot(0, qApp, [button] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      ASSERT_NE(box, nullptr);
      box->button(button)->click();
    });
  }

  QByteArray bytes(const char* name) const {
    QFile file(path(QString::fromUtf8(name)));
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
  }

  /// scene.txtpb in the first tab, changed; other.txtpb, changed too, in front.
  void open_two() {
    open(sound);
    window.editor()->set_text(QString::fromUtf8(sound) + QStringLiteral("# first\n"));
    write(QStringLiteral("other.txtpb"), sound);
    window.open(path(QStringLiteral("other.txtpb")));
    window.editor()->set_text(QString::fromUtf8(sound) + QStringLiteral("# second\n"));
    ASSERT_EQ(window.scenes().count(), 2);
    ASSERT_EQ(window.scenes().currentIndex(), 1);
  }
};

TEST_F(Close, SavesTheTabThatIsClosedAndNotTheOneInFront) {
  open_two();
  answer(QMessageBox::Save);
  Q_EMIT window.scenes().tabCloseRequested(0);
  EXPECT_EQ(window.scenes().count(), 1);
  EXPECT_EQ(bytes("scene.txtpb"), QByteArray(sound) + "# first\n");
  EXPECT_EQ(bytes("other.txtpb"), QByteArray(sound));
}

TEST_F(Close, WritesNothingWhereChangesAreDiscardedAndKeepsTheTabWhereItIsCancelled) {
  open_two();
  answer(QMessageBox::Cancel);
  Q_EMIT window.scenes().tabCloseRequested(0);
  EXPECT_EQ(window.scenes().count(), 2);
  answer(QMessageBox::Discard);
  Q_EMIT window.scenes().tabCloseRequested(0);
  EXPECT_EQ(window.scenes().count(), 1);
  EXPECT_EQ(bytes("scene.txtpb"), QByteArray(sound));
}

}  // namespace
}  // namespace metamer::gui
