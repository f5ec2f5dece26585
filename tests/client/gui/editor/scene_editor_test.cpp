// The text of a scene: what stands where, and what is shown of problems.
#include "client/gui/editor/scene_editor.h"

#include <gtest/gtest.h>

namespace metamer::gui {
namespace {

EditorProblem editor_problem(int line, int column, const char* message) {
  return {line, column, QString::fromUtf8(message)};
}

TEST(SceneEditor, CountsColumnsInBytesFromOne) {
  SceneEditor editor;
  editor.set_text(QStringLiteral("ä\nbö \"x\"\n"));
  editor.go_to(2, 5);
  EXPECT_EQ(editor.line(), 2);
  EXPECT_EQ(editor.column(), 5);
}

TEST(SceneEditor, APlaceBehindTheTextIsItsEnd) {
  SceneEditor editor;
  editor.set_text(QStringLiteral("a\nb"));
  editor.go_to(9, 9);
  EXPECT_EQ(editor.line(), 2);
  editor.go_to(1, 9);
  EXPECT_EQ(editor.line(), 1);
  EXPECT_EQ(editor.column(), 2);
  editor.go_to(0, 0);
  EXPECT_EQ(editor.line(), 1);
  EXPECT_EQ(editor.column(), 1);
}

TEST(SceneEditor, GoingToAProblemOpensItsBoxAndTypingClosesIt) {
  SceneEditor editor;
  editor.set_text(QStringLiteral("light {\n}\n"));
  editor.show_problems(
      {editor_problem(1, 1, "light needs a spectrum"), editor_problem(7, 1, "no such line")});
  EXPECT_EQ(editor.box(), QString());
  editor.go_to(1, 1);
  EXPECT_EQ(editor.box(), QStringLiteral("light needs a spectrum"));
  editor.go_to(2, 1);
  EXPECT_EQ(editor.box(), QString());
  editor.go_to(1, 1);
  editor.insert(QStringLiteral("x"));
  EXPECT_EQ(editor.box(), QString());
  EXPECT_EQ(editor.text(), QStringLiteral("xlight {\n}\n"));
}

}  // namespace
}  // namespace metamer::gui
