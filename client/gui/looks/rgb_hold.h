#pragma once

#include <QObject>

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// While R is held the live view shows what three numbers make of the scene: the same by `rgb`. In
/// the menu it is switched.
class RgbHold : public QObject {
  Q_OBJECT
 public:
  explicit RgbHold(MainWindow& window);

  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void watch();
  void show(bool rgb);
  void hold(bool held);

  MainWindow& window_;
  QAction* action_;
  bool held_ = false;
};

}  // namespace metamer::gui
