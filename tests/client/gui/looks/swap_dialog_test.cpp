#include "client/gui/looks/swap_dialog.h"

#include <QMimeData>
#include <QUrl>

#include "client/gui/looks/spectrum_drop.h"
#include "tests/client/gui/command_line.h"
#include "tests/client/gui/looks/looked_scene.h"

namespace metamer::gui {
namespace {

class SwapDialogTest : public LookedScene {
 protected:
  void SetUp() override {
    LookedScene::SetUp();
    open(QByteArray(without_looks) + looks);
  }

  /// A dialog in which this word was chosen, or did not work.
  std::unique_ptr<SwapDialog> dialog_with(Swapped what, const QString& target,
                                          const QString& word) {
    auto dialog = std::make_unique<SwapDialog>(*window.document(), what);
    dialog->set_target(target);
    bool settled = false;
    QObject::connect(dialog.get(), &SwapDialog::settled, [&] { settled = true; });
    dialog->set_word(word);
    EXPECT_TRUE(wait([&] { return settled; }));
    return dialog;
  }

  v1::Scene shown() { return window.document()->effective().value_or(v1::Scene()); }
};

TEST_F(SwapDialogTest, WhatIsChosenIsSeenAtOnceAndGoneWhenItIsLeft) {
  const std::string before = effective();
  const auto dialog = dialog_with(Swapped::light, QStringLiteral("*"), QStringLiteral("F11"));
  ASSERT_TRUE(dialog->is_chosen());
  EXPECT_EQ(shown().light(1).spectrum().standard(), "F11");
  dialog->show();
  take_shot(*dialog, QStringLiteral("light"));
  dialog->reject();
  EXPECT_EQ(effective(), before);
  EXPECT_EQ(window.document()->undo().count(), 0);
}

TEST_F(SwapDialogTest, WhatIsTakenIsOneCommand) {
  const std::string before = effective();
  const auto dialog = dialog_with(Swapped::light, QStringLiteral("fill"), QStringLiteral("2856K"));
  dialog->accept();
  EXPECT_EQ(shown().light(0).spectrum().standard(), "D65");
  EXPECT_EQ(shown().light(1).spectrum().standard(), "2856K");
  EXPECT_EQ(window.document()->undo().count(), 1);
  window.document()->undo().undo();
  EXPECT_EQ(effective(), before);
}

TEST_F(SwapDialogTest, APaintIsATestColourOrAFileOfTheScenesFolder) {
  write("blue.txt", "400 0.8\n550 0.2\n700 0.1\n");
  for (const char* word : {"TCS09", "blue.txt"}) {
    const auto dialog =
        dialog_with(Swapped::paint, QStringLiteral("grey"), QString::fromUtf8(word));
    ASSERT_TRUE(dialog->is_chosen()) << word;
    dialog->accept();
    const v1::Spectrum paint = shown().material(1).diffuse();
    EXPECT_GT(paint.samples().value_size(), 2) << word;
    EXPECT_EQ(shown().material(0).diffuse().file(), "red.txt");
  }
}

TEST_F(SwapDialogTest, WhatIsNoneOfItsKindIsSaidAndCantBeTaken) {
  const std::string before = effective();
  const std::pair<Swapped, const char*> wrong[] = {
      {Swapped::light, "TCS09"},       {Swapped::paint, "D65"}, {Swapped::light, "F13"},
      {Swapped::paint, "nowhere.txt"}, {Swapped::light, ""},    {Swapped::paint, "."}};
  for (const auto& [what, word] : wrong) {
    const auto dialog = dialog_with(what, QStringLiteral("grey"), QString::fromUtf8(word));
    EXPECT_FALSE(dialog->is_chosen()) << word;
    dialog->accept();
    EXPECT_EQ(effective(), before) << word;
  }
  EXPECT_EQ(window.document()->undo().count(), 0);
}

TEST_F(SwapDialogTest, OfAFastTypistTheLastWordCounts) {
  SwapDialog dialog(*window.document(), Swapped::light);
  int settled = 0;
  QObject::connect(&dialog, &SwapDialog::settled, [&] { ++settled; });
  for (const char* word : {"F", "F1", "F11", "A"}) dialog.set_word(QString::fromUtf8(word));
  ASSERT_TRUE(wait([&] { return settled > 0; }));
  EXPECT_EQ(settled, 1);
  EXPECT_EQ(shown().light(0).spectrum().standard(), "A");
}

TEST(SpectrumDrop, TakesWordsAndFilesThatAreNoPicturesOrScenes) {
  const auto of_file = [](const char* name) {
    QMimeData data;
    data.setUrls({QUrl::fromLocalFile(QString::fromUtf8(name))});
    return SpectrumDrop::word_of(data);
  };
  EXPECT_EQ(of_file("/tmp/lamp.csv"), QStringLiteral("/tmp/lamp.csv"));
  for (const char* other : {"/tmp/a.png", "/tmp/a.EXR", "/tmp/scene.txtpb"})
    EXPECT_TRUE(of_file(other).isEmpty()) << other;
  QMimeData words;
  words.setText(QStringLiteral(" F11 \n"));
  EXPECT_EQ(SpectrumDrop::word_of(words), QStringLiteral("F11"));
  words.setText(QStringLiteral("two\nlines"));
  EXPECT_TRUE(SpectrumDrop::word_of(words).isEmpty());
  EXPECT_TRUE(SpectrumDrop::word_of(QMimeData()).isEmpty());
}

TEST_F(SwapDialogTest, HeldRIsRgbAndLetGoIsNot) {
  window.show();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&window));
  Canvas& canvas = window.live()->canvas();
  canvas.setFocus();
  QAction* rgb = action(QStringLiteral("light.rgb"));
  const std::string before = effective();
  QTest::keyPress(&canvas, Qt::Key_R);
  EXPECT_TRUE(rgb->isChecked());
  QTest::keyRelease(&canvas, Qt::Key_R);
  EXPECT_FALSE(rgb->isChecked());
  QTest::keyPress(&canvas, Qt::Key_R);
  window.editor()->setFocus();
  EXPECT_FALSE(rgb->isChecked()) << "the release goes elsewhere";
  EXPECT_EQ(effective(), before);
  EXPECT_EQ(window.document()->undo().count(), 0);
}

}  // namespace
}  // namespace metamer::gui
