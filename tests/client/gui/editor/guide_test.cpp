// Completion and help in the editor of a scene.
#include "client/gui/editor/completion.h"
#include "tests/client/gui/opened_scene.h"

namespace metamer::gui {
namespace {

class Guide : public OpenedScene {
 protected:
  /// The caret behind the first `place` of the scene.
  void go_behind(const char* place) {
    const QByteArray before = QByteArray(sound).left(QByteArray(sound).indexOf(place)) + place;
    const auto line = before.lastIndexOf('\n');
    window.editor()->go_to(static_cast<int>(before.count('\n')) + 1,
                           static_cast<int>(before.size() - line));
  }
  Completion& completion() { return window.editor()->completion(); }
};

TEST_F(Guide, TheLineBelowSaysWhatTheCaretIsAt) {
  open(sound);
  go_behind("diffusen");
  EXPECT_TRUE(wait([&] {
    return window.editor()->help_line().startsWith(
        QStringLiteral("diffuseness: number — d of E[2.2-5]"));
  })) << window.editor()->help_line().toStdString();
}

TEST_F(Guide, CtrlSpaceListsTheNamesOfTheScenesMaterials) {
  open(replaced("material { name: \"red\"",
                "material { name: \"rose\" diffuse { constant: 1 } }\nmaterial { name: \"red\""));
  window.show();
  window.editor()->go_to(6, 34);
  action("edit.complete")->trigger();
  ASSERT_TRUE(wait([&] { return !completion().shown().isEmpty(); }));
  EXPECT_EQ(completion().shown().join(QLatin1Char(' ')), QStringLiteral("rose red"));
}

TEST_F(Guide, TheOnlyWordThatFitsIsPutInItsPlaceAsOneStep) {
  open(replaced("diffuseness", "diffusen"));
  go_behind("diffusen");
  action("edit.complete")->trigger();
  ASSERT_TRUE(wait([&] { return window.editor()->text() == QString::fromUtf8(sound); }));
  window.editor()->undo();
  EXPECT_EQ(window.editor()->text(), QString::fromUtf8(replaced("diffuseness", "diffusen")));
}

TEST_F(Guide, ANameThatIsTypedBringsItsList) {
  open(sound);
  window.show();
  go_behind("position { z: 4 }");
  QTest::keyClicks(&window.editor()->viewport(), QStringLiteral(" re"));
  ASSERT_TRUE(wait(
      [&] { return completion().shown() == QStringList(QStringLiteral("reference_distance: ")); }));
  QTest::keyClick(&window.editor()->viewport(), Qt::Key_Tab);
  EXPECT_TRUE(window.editor()->text().contains(QStringLiteral("} reference_distance:  spectrum")));
}

TEST_F(Guide, TypingInFrontOfAWordBringsNone) {
  SceneEditor editor;
  EditorProviders providers;
  providers.words = [&](const QByteArray&, int, auto done) {
    done({0, 10, {QStringLiteral("reference_distance: ")}});
  };
  editor.set_text(QStringLiteral("spectrum"));
  editor.set_providers(providers);
  QTest::keyClicks(&editor.viewport(), QStringLiteral("re"));
  EXPECT_EQ(editor.text(), QStringLiteral("respectrum"));
  EXPECT_TRUE(editor.completion().shown().isEmpty());
}

TEST_F(Guide, AnAnswerThatComesTooLateIsDropped) {
  SceneEditor editor;
  std::function<void(const EditorWords&)> answer;
  EditorProviders providers;
  providers.words = [&](const QByteArray&, int, auto done) { answer = done; };
  editor.set_providers(providers);
  editor.set_text(QStringLiteral("ab"));
  editor.complete();
  editor.go_to(1, 3);
  answer({0, 2, {QStringLiteral("abc")}});
  EXPECT_EQ(editor.text(), QStringLiteral("ab"));
}

TEST_F(Guide, AMessageFoldsAndAPlaceInItUnfolds) {
  open("light {\n  name: \"a\"\n}\nobject {\n}\n");
  SceneEditor& editor = *window.editor();
  editor.toggle_fold(1);
  EXPECT_FALSE(editor.shows_line(2));
  EXPECT_TRUE(editor.shows_line(4));
  editor.go_to(2, 1);
  EXPECT_TRUE(editor.shows_line(2));
}

}  // namespace
}  // namespace metamer::gui
