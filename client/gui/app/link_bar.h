#pragma once

#include <QElapsedTimer>
#include <QLabel>
#include <QPushButton>
#include <QTimer>
#include <QWidget>

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// What keeps the window from its server, and what can be done: a strip over scenes and pictures,
/// which go on beside it. Hidden while all is well.
class LinkBar : public QWidget {
  Q_OBJECT
 public:
  explicit LinkBar(Link& link, QWidget* parent = nullptr);

  QString text() const { return text_->text(); }

 Q_SIGNALS:
  void other_asked();  ///< Another server.

 private:
  void follow();
  void show_text();

  Link& link_;
  QLabel* text_;
  QPushButton *now_, *stop_, *own_, *other_;
  QElapsedTimer since_;
  QTimer beat_;  ///< While something is counted.
};

/// Puts it over the window's middle.
void add_link_bar(MainWindow& window);

}  // namespace metamer::gui
