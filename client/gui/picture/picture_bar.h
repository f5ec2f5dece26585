#pragma once

#include <QDoubleSpinBox>
#include <QToolBar>

#include "client/gui/app/main_window.h"
#include "client/gui/picture/viewing.h"

namespace metamer::gui {

/// How all pictures of the window are looked at: exposure, what is out of gamut, numbers.
class PictureBar : public QToolBar {
  Q_OBJECT
 public:
  explicit PictureBar(MainWindow& window);

  const Viewing& viewing() const { return viewing_; }
  void set_stops(double stops);
  void set_display(const QColorSpace& display);

 private:
  void show_everywhere();
  void show_on(PicturePage& page);

  MainWindow& window_;
  Viewing viewing_;
  bool numbers_ = true;
  QDoubleSpinBox* stops_;
};

}  // namespace metamer::gui
