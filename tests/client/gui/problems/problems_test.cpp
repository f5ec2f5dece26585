// The dock of problems, and the ways to their places.
#include <QAbstractItemModelTester>
#include <QSignalSpy>

#include "client/gui/problems/problems_dock.h"
#include "tests/client/gui/opened_scene.h"

namespace metamer::gui {
namespace {

Problem at(const char* file, int line, int column, const char* message = "is odd") {
  return {.field = {}, .file = file, .line = line, .column = column, .message = message};
}

TEST(ProblemTable, IsAModelAsQtAsksForIt) {
  ProblemTable table;
  // Warnings of Qt fail the test.
  const QAbstractItemModelTester tester(&table,
                                        QAbstractItemModelTester::FailureReportingMode::Warning);
  table.set_problems({at("b", 2, 1), at("a", 1, 5), at("s", 3, 1)}, QStringLiteral("s"));
  EXPECT_EQ(table.rowCount(), 3);
  table.set_problems({}, {});
  EXPECT_EQ(table.rowCount(), 0);
}

TEST(ProblemTable, TheScenesOwnStandFirstFromItsTop) {
  ProblemTable table;
  table.set_problems({at("dir/b", 2, 1), at("s", 9, 1), at("s", 3, 7), at("s", 3, 2)},
                     QStringLiteral("s"));
  QStringList places;
  for (int row = 0; row < table.rowCount(); ++row)
    places << table.index(row, ProblemTable::place).data().toString();
  EXPECT_EQ(places.join(QLatin1Char(' ')), QStringLiteral("3:2 3:7 9:1 b:2:1"));
}

TEST(ProblemTable, NextGoesRoundBothWays) {
  ProblemTable table;
  const QString own = QStringLiteral("s"), other = QStringLiteral("t");
  EXPECT_EQ(table.next(own, 1, 1, false), -1);
  table.set_problems({at("s", 3, 2), at("s", 9, 1), at("t", 1, 1)}, own);
  EXPECT_EQ(table.next(own, 1, 1, false), 0);
  EXPECT_EQ(table.next(own, 3, 2, false), 1);
  EXPECT_EQ(table.next(own, 9, 1, false), 2);
  EXPECT_EQ(table.next(other, 1, 1, false), 0);
  EXPECT_EQ(table.next(own, 1, 1, true), 2);
  EXPECT_EQ(table.next(own, 9, 1, true), 0);
  EXPECT_EQ(table.next(other, 1, 1, true), 1);
}

class Problems : public OpenedScene {
 protected:
  ProblemsDock& dock() { return *window.findChild<ProblemsDock*>(); }
  int rows() { return dock().table().rowCount(); }
};

TEST_F(Problems, ASoundSceneHasNone) {
  open(sound);
  EXPECT_EQ(rows(), 0);
}

TEST_F(Problems, F8GoesFromOneToTheNextAndRound) {
  open(replaced("material: \"red\"", "material: \"rad\"")
           .replace("radius: 1", "radius: -1")
           .replace("diffuseness: 1", "diffuseness: 2"));
  ASSERT_EQ(rows(), 3);
  std::vector<int> lines;
  for (int i = 0; i < 4; ++i) {
    action("edit.next_problem")->trigger();
    lines.push_back(window.editor()->line());
  }
  EXPECT_EQ(lines, (std::vector<int>{4, 5, 5, 4}));
  action("edit.previous_problem")->trigger();
  EXPECT_EQ(window.editor()->line(), 5);
}

TEST_F(Problems, EnterOnARowPutsTheCaretThere) {
  open(replaced("radius: 1", "radius: -1"));
  ASSERT_EQ(rows(), 1);
  window.show();
  dock().view().setFocus();
  dock().view().setCurrentIndex(dock().table().index(0, ProblemTable::sentence));
  QTest::keyClick(&dock().view(), Qt::Key_Return);
  EXPECT_EQ(window.editor()->line(), 5);
  EXPECT_EQ(window.editor()->column(), QByteArray(sound).split('\n').at(4).indexOf("radius") + 1);
}

TEST_F(Problems, OneInAnotherFileOpensThatFileAtItsLine) {
  write(QStringLiteral("red.txt"), "400 0.1\n500 x\n");
  open(sound);
  ASSERT_EQ(rows(), 1);
  action("edit.next_problem")->trigger();
  ASSERT_EQ(window.scenes().count(), 2);
  EXPECT_EQ(window.document(), nullptr);
  ASSERT_NE(window.file(), nullptr);
  EXPECT_EQ(window.file()->title(), QStringLiteral("red.txt"));
  EXPECT_EQ(window.editor()->line(), 2);
  EXPECT_NE(window.editor()->box(), QString());
  // The list stays the scene's, and the way there a second time opens nothing more.
  EXPECT_EQ(rows(), 1);
  dock().go_to(0);
  EXPECT_EQ(window.scenes().count(), 2);
}

TEST_F(Problems, WhatAServerRefusesIsShownUntilTheNextCheck) {
  open(sound);
  window.document()->set_server_problems(
      {{.field = "object[0].sphere.radius", .file = {}, .message = "too large for the server"}});
  ASSERT_EQ(rows(), 1);
  dock().go_to(0);
  EXPECT_EQ(window.editor()->line(), 5);
  window.document()->check_now();
  EXPECT_TRUE(wait([&] { return rows() == 0; }));
}

TEST_F(Problems, AreThoseOfTheSceneInFront) {
  open(replaced("radius: 1", "radius: -1"));
  EXPECT_EQ(rows(), 1);
  action("file.new")->trigger();
  EXPECT_EQ(rows(), 0);
  window.scenes().setCurrentIndex(0);
  EXPECT_EQ(rows(), 1);
  action("file.close")->trigger();
  action("file.close")->trigger();
  EXPECT_EQ(rows(), 0);
  action("edit.next_problem")->trigger();
}

}  // namespace
}  // namespace metamer::gui
