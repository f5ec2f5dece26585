// A window that closes while its own server has jobs.
#include "client/gui/jobs/quit_question.h"

#include <gtest/gtest.h>

#include <QAbstractButton>

#include "jobs_window.h"

namespace metamer::test {
namespace {

/// A window with a job under way.
class Quit : public testing::Test {
 protected:
  void start(const std::string& settings) {
    test.emplace(blink_scene(settings));
    test->choose("render.render");
    page = test->job();
    ASSERT_NE(page, nullptr);
    ASSERT_TRUE(comes([this] { return page->title().contains(QLatin1Char('%')); }));
  }
  gui::MainWindow& window() { return test->window(); }
  QMessageBox* box() { return window().findChild<gui::QuitQuestion*>()->box(); }
  bool is_asked() {
    window().close();
    return comes([this] { return box() != nullptr; });
  }
  void answer(const char* text) {
    for (QAbstractButton* button : box()->buttons())
      if (button->text().remove(QLatin1Char('&')) == QString::fromUtf8(text))
        return button->click();
    FAIL() << text;
  }

  std::optional<JobsWindow> test;
  gui::JobPage* page = nullptr;
};

constexpr const char* endless = "width: 2048 height: 2048 spp: 1024 tile_size: 8";

TEST_F(Quit, StayGoesOnAndCancelCloses) {
  start(endless);
  ASSERT_TRUE(is_asked());
  EXPECT_TRUE(box()->informativeText().contains(QStringLiteral("scene.txtpb")));
  answer("Stay");
  EXPECT_TRUE(window().isVisible());
  EXPECT_FALSE(page->panel().ended());
  ASSERT_TRUE(is_asked());
  answer("Cancel them");
  EXPECT_FALSE(window().isVisible());
}

TEST_F(Quit, WaitClosesWhenTheJobHasEnded) {
  start(endless);
  ASSERT_TRUE(is_asked());
  answer("Wait for them");
  ASSERT_TRUE(comes([this] { return box() != nullptr; })) << "it says what it waits for";
  EXPECT_TRUE(window().isVisible());
  page->cancel();
  EXPECT_TRUE(comes([this] { return !window().isVisible(); }));
}

TEST_F(Quit, AsksNothingWhereAllHaveEnded) {
  start(endless);
  page->cancel();
  ASSERT_TRUE(comes([this] { return page->panel().ended(); }));
  window().close();
  EXPECT_TRUE(comes([this] { return !window().isVisible(); }));
  EXPECT_EQ(box(), nullptr);
}

}  // namespace
}  // namespace metamer::test
