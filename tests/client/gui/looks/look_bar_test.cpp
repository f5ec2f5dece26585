#include "client/gui/looks/look_bar.h"

#include <QInputDialog>
#include <QTimer>

#include "client/gui/looks/look_command.h"
#include "client/gui/looks/settings_actions.h"
#include "client/tools/scene/look_change.h"
#include "tests/client/gui/looks/looked_scene.h"

namespace metamer::gui {
namespace {

using LookBarTest = LookedScene;

QString look_id(int number) { return QStringLiteral("light.look.%1").arg(number); }

TEST_F(LookBarTest, HasTheLooksOfTheSceneByNumberAndName) {
  open(QByteArray(without_looks) + looks);
  EXPECT_EQ(action(look_id(1))->iconText(), QStringLiteral("1 day"));
  EXPECT_EQ(action(look_id(3))->text(), QStringLiteral("&3 shop && home"));
  EXPECT_TRUE(action(look_id(3))->isVisible());
  EXPECT_FALSE(action(look_id(4))->isVisible());
}

TEST_F(LookBarTest, OfASceneWithoutLooksHasTheStandardLights) {
  open(without_looks);
  EXPECT_EQ(action(look_id(1))->iconText(), QStringLiteral("1 D65"));
  EXPECT_EQ(action(look_id(2))->iconText(), QStringLiteral("2 A"));
}

TEST_F(LookBarTest, AKeyOnThePictureChoosesALook) {
  open(QByteArray(without_looks) + looks);
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
  window.live()->canvas().setFocus();
  QTest::keyClick(&window.live()->canvas(), Qt::Key_2);
  EXPECT_EQ(window.document()->effective()->light(0).spectrum().standard(), "A");
  EXPECT_EQ(window.document()->effective()->light(1).spectrum().standard(), "A");
  QTest::keyClick(&window.live()->canvas(), Qt::Key_0);
  EXPECT_EQ(window.document()->effective()->light(1).spectrum().standard(), "D65");
}

TEST_F(LookBarTest, TheButtonIsDownThatWouldChangeNothing) {
  open(QByteArray(without_looks) + looks);
  for (const int number : {2, 3, 1}) {
    action(look_id(number))->trigger();
    for (int other = 1; other <= 3; ++other)
      EXPECT_EQ(action(look_id(other))->isChecked(), other == number) << number;
    const std::string before = effective();
    const int commands = window.document()->undo().count();
    action(look_id(number))->trigger();
    EXPECT_EQ(effective(), before);
    EXPECT_EQ(window.document()->undo().count(), commands) << "nothing to undo";
    EXPECT_TRUE(action(look_id(number))->isChecked());
  }
}

TEST_F(LookBarTest, UndoOfEveryActionThatChangesTheLookGivesTheLookBefore) {
  open(QByteArray(without_looks) + looks);
  Document& document = *window.document();
  const std::string own = effective();
  QStringList ids{look_id(1),
                  look_id(2),
                  look_id(3),
                  QStringLiteral("light.look.none"),
                  QStringLiteral("view.device.other"),
                  QStringLiteral("view.lighting.next")};
  for (const ChoiceMenu& menu : choice_menus()) ids += menu.actions;
  for (int round = 0; round < 2; ++round)
    for (const QString& id : ids) {
      const std::string before = effective();
      const int at = document.undo().index();
      action(id)->trigger();
      const std::string after = effective();
      EXPECT_EQ(document.undo().index(), before == after ? at : at + 1) << id.toStdString();
      if (before == after) continue;
      action(QStringLiteral("edit.undo"))->trigger();
      EXPECT_EQ(effective(), before) << id.toStdString();
      action(QStringLiteral("edit.redo"))->trigger();
      EXPECT_EQ(effective(), after) << id.toStdString();
    }
  while (document.undo().canUndo()) document.undo().undo();
  EXPECT_EQ(effective(), own);
}

TEST_F(LookBarTest, ACameraThatWasMovedComesBackWhenALookWithOneIsUndone) {
  open(QByteArray(without_looks) + looks);
  v1::Camera moved;
  moved.mutable_eye()->set_y(7);
  window.document()->set_camera(moved);
  action(look_id(3))->trigger();
  EXPECT_EQ(window.document()->effective()->camera().eye().x(), 4);
  window.document()->undo().undo();
  EXPECT_EQ(window.document()->effective()->camera().eye().y(), 7);
}

TEST_F(LookBarTest, WhatIsDraggedIsUndoneAsOne) {
  open(without_looks);
  Document& document = *window.document();
  const std::string before = effective();
  for (int i = 1; i < 20; ++i) {
    v1::LookLight light;
    light.set_name("key");
    light.set_luminance(i / 20.0);
    client::Look look = document.look();
    client::set_light(light, look);
    document.undo().push(new LookCommand(document, look, QStringLiteral("luminance"), 7));
  }
  EXPECT_EQ(document.effective()->light(0).luminance(), 19 / 20.0);
  EXPECT_EQ(document.undo().count(), 1);
  document.undo().undo();
  EXPECT_EQ(effective(), before);
}

TEST_F(LookBarTest, EveryValueOfTheSettingsHasAnActionWhichIsCheckedWhenItIsShown) {
  open(without_looks);
  const QList<const google::protobuf::EnumDescriptor*> enumerations{
      v1::Backend_descriptor(), v1::Shading_descriptor(), v1::Observer_descriptor(),
      v1::Adaptation_descriptor()};
  const QList<ChoiceMenu> menus = choice_menus();
  ASSERT_EQ(menus.size(), enumerations.size());
  for (int i = 0; i < menus.size(); ++i) {
    ASSERT_EQ(menus[i].actions.size(), enumerations[i]->value_count());
    for (const QString& chosen : menus[i].actions) {
      action(chosen)->trigger();
      for (const QString& other : menus[i].actions)
        EXPECT_EQ(action(other)->isChecked(), other == chosen) << other.toStdString();
    }
  }
}

TEST_F(LookBarTest, ALookThatIsKeptStandsInTheTextAndIsDown) {
  open(QByteArray(without_looks) + looks);
  action(look_id(2))->trigger();
  v1::LookMaterial paint;
  paint.set_name("red");
  paint.mutable_diffuse()->set_constant(0.25);
  client::Look look = window.document()->look();
  client::set_material(paint, look);
  window.document()->set_look(look);
  const std::string shown = effective();
  bar()->keep_as(QStringLiteral("mine"));
  ASSERT_TRUE(wait([&] { return bar()->scene().look_size() == 4; }));
  EXPECT_EQ(bar()->scene().look(3).name(), "mine");
  action(QStringLiteral("light.look.none"))->trigger();
  action(look_id(4))->trigger();
  v1::Scene before, after;
  EXPECT_EQ(window.document()->effective()->material(0).diffuse().constant(), 0.25);
  EXPECT_EQ(window.document()->effective()->light(1).spectrum().standard(), "A");
  window.editor()->undo();
  EXPECT_EQ(window.editor()->text().toStdString(), std::string(without_looks) + looks);
}

TEST_F(LookBarTest, TheStandardOnesAreKeptBesideTheFirstOfASceneWithoutLooks) {
  open(without_looks);
  action(look_id(2))->trigger();
  const int standard = bar()->scene().look_size();
  bar()->keep_as(QStringLiteral("mine"));
  ASSERT_TRUE(wait([&] { return !window.document()->sound()->scene().look().empty(); }));
  EXPECT_EQ(window.document()->sound()->scene().look_size(), standard + 1);
  EXPECT_EQ(action(look_id(2))->iconText(), QStringLiteral("2 A"));
}

TEST_F(LookBarTest, WhatIsWrittenIntoTheSceneMakesTheSameOfItWhenItIsOpenedAgain) {
  open(QByteArray("# lamps\n") + without_looks + looks);
  Document& document = *window.document();
  action(look_id(2))->trigger();
  action(QStringLiteral("view.device.gl"))->trigger();
  action(QStringLiteral("light.adaptation.bradford"))->trigger();
  v1::Camera moved = document.seen_camera();
  moved.mutable_eye()->set_y(0.1 + 0.2);
  document.set_camera(moved);
  v1::Scene shown = *document.effective();
  const QString before = window.editor()->text();
  bar()->write_as(QStringLiteral("A"));
  ASSERT_TRUE(wait([&] { return window.editor()->text() != before && document.settled(); }));
  EXPECT_TRUE(document.checked()->sound());
  EXPECT_TRUE(action(look_id(2))->isChecked());

  document.set_camera(std::nullopt);
  document.set_look({});
  action(look_id(2))->trigger();
  v1::Scene read = *document.effective();
  ASSERT_EQ(read.look_size(), 3);
  for (v1::Scene* one : {&shown, &read}) one->clear_look();
  EXPECT_EQ(read.DebugString(), shown.DebugString());

  window.editor()->undo();
  EXPECT_EQ(window.editor()->text(), before);
}

TEST_F(LookBarTest, TheActionThatWritesALookAsksForItsNameAndProposesTheOneThatIsDown) {
  open(QByteArray(without_looks) + looks);
  action(look_id(3))->trigger();
  QTimer::singleShot(0, &window, [this] {
    auto* dialog = window.findChild<QInputDialog*>();
    ASSERT_NE(dialog, nullptr);
    EXPECT_EQ(dialog->textValue(), QStringLiteral("shop & home"));
    dialog->setTextValue(QStringLiteral("of my own"));
    dialog->accept();
  });
  action(QStringLiteral("edit.write_look"))->trigger();
  ASSERT_TRUE(wait([&] { return bar()->scene().look_size() == 4; }));
  EXPECT_EQ(bar()->scene().look(3).name(), "of my own");
}

TEST_F(LookBarTest, UndoBelongsToTheSideThatHasTheFocus) {
  open(QByteArray(without_looks) + looks);
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
  const QString text = window.editor()->text();
  window.editor()->replace(0, 0, QStringLiteral("# typed\n"));
  window.live()->canvas().setFocus();
  action(look_id(2))->trigger();
  QTest::keyClick(&window.live()->canvas(), Qt::Key_Z, Qt::ControlModifier);
  EXPECT_EQ(window.document()->effective()->light(0).spectrum().standard(), "D65");
  EXPECT_NE(window.editor()->text(), text);
  window.editor()->setFocus();
  action(QStringLiteral("edit.undo"))->trigger();
  EXPECT_EQ(window.editor()->text().toStdString(), text.toStdString());
}

}  // namespace
}  // namespace metamer::gui
