#pragma once

#include <QLabel>

#include "client/gui/picture/picture_bar.h"

namespace metamer::gui {

/// Shows pictures in the colours of the window's display, and says in the status bar of which.
class Display : public QObject {
  Q_OBJECT
 public:
  Display(MainWindow& window, PictureBar& bar);

  /// By hand; empty: colord's again. Kept in the settings.
  void choose(const QString& file);

 private:
  void find(const QString& file);
  void ask();

  MainWindow& window_;
  PictureBar& bar_;
  QLabel* label_;
  unsigned asked_ = 0;  ///< The newest counts.
};

}  // namespace metamer::gui
