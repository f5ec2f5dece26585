// What was not saved when a program ended by itself, and what was open when it ended as it should.
#include <QDir>
#include <QMessageBox>
#include <QPushButton>

#include "client/gui/files/lost_texts.h"
#include "client/gui/files/open_files.h"
#include "client/gui/files/unsaved_texts.h"
#include "tests/client/gui/opened_scene.h"

namespace metamer::gui {
namespace {

using UnsavedText = OpenedScene;

TEST_F(UnsavedText, ATextThatWasNotSavedIsOfferedAfterACrash) {
  QTemporaryDir root;
  open(sound);
  auto kept = std::make_unique<UnsavedTexts>(root.path());
  kept->add(window.document());
  kept->keep();
  EXPECT_TRUE(QDir(root.path()).isEmpty()) << "nothing is to be kept of what is saved";
  window.editor()->insert(QStringLiteral("# not saved\n"));
  kept->keep();
  const auto texts = [&] {
    int found = 0;
    for (const QString& run : QDir(root.path()).entryList(QDir::Dirs | QDir::NoDotAndDotDot))
      found += static_cast<int>(
          QDir(root.filePath(run)).entryList({QStringLiteral("*.json")}, QDir::Files).size());
    return found;
  };
  ASSERT_TRUE(wait([&] { return texts() == 1; }));
  EXPECT_TRUE(UnsavedTexts::lost(root.path()).empty()) << "it runs";

  // A run that is no more has no lock.
  QTemporaryDir ended;
  const QDir runs(root.path());
  const QString run = runs.entryList(QDir::Dirs | QDir::NoDotAndDotDot).front();
  ASSERT_TRUE(QDir(ended.path()).mkdir(run));
  for (const QString& name : QDir(runs.filePath(run)).entryList({QStringLiteral("*.json")}))
    QFile::copy(QDir(runs.filePath(run)).filePath(name),
                ended.filePath(run + QLatin1Char('/') + name));
  const QString before = window.editor()->text();
  window.editor()->undo();
  offer_lost_texts(window, ended.path());
  ASSERT_TRUE(wait([&] { return window.findChild<QMessageBox*>() != nullptr; }));
  auto* box = window.findChild<QMessageBox*>();
  EXPECT_TRUE(box->text().contains(QStringLiteral("scene.txtpb")));
  box->buttons().front()->click();
  ASSERT_TRUE(wait([&] { return window.editor()->text() == before; }));
  EXPECT_EQ(window.scenes().count(), 1) << "its tab is open";
  EXPECT_EQ(window.document()->path(), path(QStringLiteral("scene.txtpb")));
  EXPECT_TRUE(window.document()->modified());
  window.editor()->undo();
  EXPECT_EQ(window.editor()->text(), QString::fromUtf8(sound));
  EXPECT_TRUE(QDir(ended.path()).isEmpty());
}

TEST_F(UnsavedText, NothingIsLeftOfAProgramThatEndsAsItShould) {
  QTemporaryDir root;
  open(sound);
  {
    UnsavedTexts kept(root.path());
    kept.add(window.document());
    window.editor()->insert(QStringLiteral("#"));
    kept.keep();
  }
  EXPECT_TRUE(QDir(root.path()).isEmpty());
}

TEST_F(UnsavedText, WhatIsUndoneToWhatWasSavedIsKeptNoLonger) {
  QTemporaryDir root;
  open(sound);
  UnsavedTexts kept(root.path());
  kept.add(window.document());
  window.editor()->insert(QStringLiteral("#"));
  kept.keep();
  const auto texts = [&] {
    const QStringList runs = QDir(root.path()).entryList(QDir::Dirs | QDir::NoDotAndDotDot);
    return runs.isEmpty()
               ? 0
               : QDir(root.filePath(runs.front())).entryList({QStringLiteral("*.json")}).size();
  };
  ASSERT_TRUE(wait([&] { return texts() == 1; }));
  window.editor()->undo();
  kept.keep();
  EXPECT_TRUE(wait([&] { return texts() == 0; }));
}

TEST_F(UnsavedText, TheNextStartOpensWhatWasOpen) {
  open(sound);
  write(QStringLiteral("other.txtpb"), sound);
  window.open(path(QStringLiteral("other.txtpb")));
  ASSERT_NE(window.open_text(path(QStringLiteral("red.txt"))), nullptr);
  action("file.new")->trigger();
  window.scenes().setCurrentIndex(1);
  window.close();

  const auto paths = [](const MainWindow& of) {
    QStringList all;
    for (const TextFile* file : of.files()) all << QFileInfo(file->path()).fileName();
    return all;
  };
  const QStringList all{QStringLiteral("scene.txtpb"), QStringLiteral("other.txtpb"),
                        QStringLiteral("red.txt")};
  {
    MainWindow next(link);
    EXPECT_TRUE(open_last_files(next));
    EXPECT_EQ(paths(next), all);
    EXPECT_EQ(next.document(), next.files()[1]);
    EXPECT_EQ(next.pictures().currentWidget(), next.live());
    next.close();
  }
  QFile::remove(path(QStringLiteral("other.txtpb")));
  {
    MainWindow next(link);
    EXPECT_TRUE(open_last_files(next)) << "what is left of them";
    EXPECT_EQ(paths(next), QStringList({all[0], all[2]}));
    while (next.scenes().count() > 0) next.close_scene(0);
    next.close();
  }
  MainWindow last(link);
  EXPECT_FALSE(open_last_files(last));
}

}  // namespace
}  // namespace metamer::gui
