// Find and replace in a text, and the bar that asks for it.
#include "client/gui/editor/search.h"

#include "client/gui/editor/find_bar.h"
#include "client/gui/editor/scene_editor.h"
#include "tests/client/gui/opened_scene.h"

namespace metamer::gui {
namespace {

SearchFor wanted_text(const char* what) { return {.what = QString::fromUtf8(what)}; }

class Search : public testing::Test {
 protected:
  void SetUp() override { editor.set_text(QStringLiteral("ball Ball ballast\nb€ll ball\n")); }

  std::vector<int> columns(const SearchFor& wanted, int steps, bool backwards = false) {
    std::vector<int> result;
    for (int i = 0; i < steps && search.find_next(wanted, backwards); ++i)
      result.push_back(10 * editor.line() + editor.column());
    return result;
  }

  SceneEditor editor;
  TextSearch search{editor.area()};
};

TEST_F(Search, NextGoesRound) {
  EXPECT_EQ(columns(wanted_text("ball"), 5), (std::vector<int>{15, 20, 25, 32, 15}));
  EXPECT_EQ(columns(wanted_text("xyz"), 5), std::vector<int>());
  EXPECT_EQ(columns(wanted_text(""), 5), std::vector<int>());
}

TEST_F(Search, OptionsNarrowIt) {
  SearchFor wanted = wanted_text("ball");
  EXPECT_EQ(search.count(wanted, 99), 4);
  wanted.match_case = true;
  EXPECT_EQ(search.count(wanted, 99), 3);
  wanted.whole_words = true;
  EXPECT_EQ(search.count(wanted, 99), 2);
  SearchFor pattern = wanted_text("b[^ ]+ll");
  pattern.pattern = true;
  EXPECT_EQ(search.count(pattern, 99), 5);
  pattern.what = QStringLiteral("b(");
  EXPECT_EQ(search.count(pattern, 99), 0);
  pattern.what = QStringLiteral("$");
  EXPECT_LE(search.count(pattern, 99), 3);
}

TEST_F(Search, AllAreReplacedInOneStep) {
  const QString before = editor.text();
  EXPECT_EQ(search.replace_all(wanted_text("ball"), QStringLiteral("ballball")), 4);
  EXPECT_EQ(editor.text(), QStringLiteral("ballball ballball ballballast\nb€ll ballball\n"));
  editor.undo();
  EXPECT_EQ(editor.text(), before);
}

TEST_F(Search, APatternsGroupsCanBeCited) {
  SearchFor pattern = wanted_text("(b)(.)ll");
  pattern.pattern = true;
  EXPECT_EQ(search.replace_all(pattern, QStringLiteral("\\2\\1")), 5);
  EXPECT_EQ(editor.text(), QStringLiteral("ab aB abast\n€b ab\n"));
}

TEST_F(Search, OnlyWhatIsFoundIsReplaced) {
  EXPECT_FALSE(search.replace_selected(wanted_text("ball"), QStringLiteral("x")));
  ASSERT_TRUE(search.find_next(wanted_text("ballast"), false));
  EXPECT_FALSE(search.replace_selected(wanted_text("ball"), QStringLiteral("x")));
  EXPECT_TRUE(search.replace_selected(wanted_text("ballast"), QStringLiteral("x")));
  EXPECT_EQ(editor.text(), QStringLiteral("ball Ball x\nb€ll ball\n"));
}

TEST_F(OpenedScene, FindOpensAboveTheTextAndEscapeClosesIt) {
  open(sound);
  window.show();
  action("edit.find")->trigger();
  FindBar& bar = window.editor()->find_bar();
  EXPECT_TRUE(bar.isVisible());
  EXPECT_FALSE(bar.by().isVisible());
  QTest::keyClicks(&bar.what(), QStringLiteral("radius"));
  EXPECT_EQ(window.editor()->selected(), QStringLiteral("radius"));
  EXPECT_EQ(window.editor()->line(), 5);
  action("edit.replace")->trigger();
  EXPECT_TRUE(bar.by().isVisible());
  QTest::keyClick(&bar, Qt::Key_Escape);
  EXPECT_FALSE(bar.isVisible());
  EXPECT_EQ(window.editor()->text(), QString::fromUtf8(sound));
}

}  // namespace
}  // namespace metamer::gui
