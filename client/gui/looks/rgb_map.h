#pragma once

#include <QPointer>

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// Where three numbers in place of spectra go wrong: the live picture by its own method and by
/// `rgb`, compared.
class RgbMap : public QObject {
  Q_OBJECT
 public:
  explicit RgbMap(MainWindow& window);

 private:
  void start();
  void compare_with(const Picture& own, LivePage* live, unsigned number);

  MainWindow& window_;
  unsigned asked_ = 0;  ///< The newest counts: a view that is lost hands nothing over.
};

}  // namespace metamer::gui
