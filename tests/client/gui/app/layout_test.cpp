// Where the window's parts stand, and how much room each has.
#include <QDockWidget>

#include "tests/client/gui/opened_scene.h"

namespace metamer::gui {
namespace {

class Layout : public OpenedScene {
 protected:
  void show(int width) {
    window.resize(width, 900);
    window.show();
    settle();
  }
  static void settle() { QTest::qWait(50); }
  QDockWidget* dock(const char* id) {
    return window.findChild<QDockWidget*>(QString::fromUtf8(id));
  }
  Qt::DockWidgetArea area(const char* id) { return window.dockWidgetArea(dock(id)); }
};

TEST_F(Layout, NoPageSqueezesTheEditor) {
  open(sound);
  show(1400);
  for (const char* page : {"compare.pictures", "compare.sheet", "help.models", "help.keys"}) {
    action(page)->trigger();
    settle();
    EXPECT_GE(window.scenes().width(), 380) << page;
  }
  EXPECT_LT(dock("problems")->height(), 160) << "there are no problems";
}

TEST_F(Layout, InANarrowWindowTheInspectorIsATabBelow) {
  open(sound);
  show(MainWindow::narrow - 1);
  EXPECT_EQ(area("inspector"), Qt::BottomDockWidgetArea);
  EXPECT_TRUE(window.tabifiedDockWidgets(dock("problems")).contains(dock("inspector")));
  EXPECT_GE(window.scenes().width(), 380);
  show(MainWindow::narrow);
  EXPECT_EQ(area("inspector"), Qt::RightDockWidgetArea);
}

TEST_F(Layout, WhatWasMovedByHandStaysWhereItIs) {
  show(1400);
  window.addDockWidget(Qt::LeftDockWidgetArea, dock("inspector"));
  show(900);
  EXPECT_EQ(area("inspector"), Qt::LeftDockWidgetArea);
}

TEST_F(Layout, ResetBringsBackWhatWasMovedOrClosed) {
  for (const int width : {1400, 1000}) {
    show(width);
    const auto before = area("inspector");
    window.addDockWidget(Qt::LeftDockWidgetArea, dock("inspector"));
    dock("problems")->close();
    action("window.reset")->trigger();
    settle();
    EXPECT_EQ(area("inspector"), before) << width;
    EXPECT_TRUE(dock("inspector")->isVisibleTo(&window)) << width;
    EXPECT_FALSE(dock("problems")->isHidden()) << width;
    EXPECT_TRUE(dock("jobs")->isHidden()) << width;
  }
}

TEST_F(Layout, TheNextStartLooksAsThisOneEnded) {
  show(1400);
  window.addDockWidget(Qt::LeftDockWidgetArea, dock("inspector"));
  dock("problems")->close();
  settle();
  window.close();
  MainWindow next(link);
  next.restore_layout();
  next.show();
  settle();
  EXPECT_EQ(next.dockWidgetArea(next.findChild<QDockWidget*>(QStringLiteral("inspector"))),
            Qt::LeftDockWidgetArea);
  EXPECT_TRUE(next.findChild<QDockWidget*>(QStringLiteral("problems"))->isHidden());
}

}  // namespace
}  // namespace metamer::gui
