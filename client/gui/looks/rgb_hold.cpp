#include "client/gui/looks/rgb_hold.h"

#include <QKeyEvent>

namespace metamer::gui {

RgbHold::RgbHold(MainWindow& window)
    : QObject(&window), window_(window), action_(window.actions()[QStringLiteral("light.rgb")]) {
  window.actions().bind_toggle(QStringLiteral("light.rgb"), [this](bool rgb) { show(rgb); });
  connect(&window, &MainWindow::document_chosen, this, &RgbHold::watch);
}

void RgbHold::watch() {
  action_->setChecked(false);
  if (window_.live() != nullptr) window_.live()->canvas().installEventFilter(this);
}

void RgbHold::show(bool rgb) {
  if (window_.live() == nullptr) return;
  v1::Method method;
  method.mutable_rgb();
  window_.live()->show_by(rgb ? std::optional(method) : std::nullopt);
}

/// A shortcut knows no release: the key is taken from it where the picture has the focus.
bool RgbHold::eventFilter(QObject*, QEvent* event) {
  if (event->type() == QEvent::FocusOut && held_) hold(false);
  const bool key = event->type() == QEvent::ShortcutOverride || event->type() == QEvent::KeyPress ||
                   event->type() == QEvent::KeyRelease;
  if (!key) return false;
  const auto& pressed = *static_cast<QKeyEvent*>(event);
  if (pressed.key() != Qt::Key_R || pressed.modifiers() != Qt::NoModifier) return false;
  event->accept();
  if (event->type() != QEvent::ShortcutOverride && !pressed.isAutoRepeat())
    hold(event->type() == QEvent::KeyPress);
  return true;
}

void RgbHold::hold(bool held) {
  held_ = held;
  action_->setChecked(held);
}

}  // namespace metamer::gui
