#pragma once

#include <gtest/gtest.h>

#include <QLabel>
#include <QPushButton>
#include <QTest>
#include <functional>

#include "client/gui/app/add_app.h"
#include "client/gui/app/link_bar.h"
#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// A window on the booth, with whatever server a test gives it.
class FaultyWindow : public testing::Test {
 protected:
  void SetUp() override {
    window_.open(find_booth());
    ASSERT_NE(window_.live(), nullptr);
    window_.resize(700, 400);
    window_.show();
    ASSERT_TRUE(wait([this] { return window_.document()->sound() != nullptr; }));
  }

  static bool wait(const std::function<bool()>& holds, int patience = 30'000) {
    return QTest::qWaitFor(holds, patience);
  }
  /// Until another live frame than this one is complete, and of now.
  bool completes(const std::shared_ptr<const LiveFrame>& before = nullptr) {
    return wait([&] {
      const auto frame = live().frame();
      return frame && frame != before && frame->frame.complete() && frame->newest &&
             live().canvas().stale().isEmpty();
    });
  }
  /// The same after an action.
  bool completes_after(const char* id) {
    const auto before = live().frame();
    action(id)->trigger();
    return completes(before);
  }
  LivePage& live() { return *window_.live(); }
  QAction* action(const char* id) { return window_.actions()[QString::fromUtf8(id)]; }
  LinkBar& bar() { return *window_.findChild<LinkBar*>(); }
  bool bar_says(const QString& text) { return bar().isVisible() && bar().text().contains(text); }
  /// A button of the bar that can be seen; null: there is none.
  QPushButton* button(const QString& text) {
    for (QPushButton* one : bar().findChildren<QPushButton*>())
      if (one->text() == text && one->isVisible()) return one;
    return nullptr;
  }
  /// A bar that has nothing more to say goes; on a busy machine it may have told of slow answers.
  bool bar_goes() {
    return wait([this] { return !bar().isVisible(); });
  }
  bool is_lost() const { return link_.status().kind == client::LinkStatus::Kind::lost; }

  Link link_;
  MainWindow window_{link_};
};

}  // namespace metamer::gui
