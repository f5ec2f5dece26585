#pragma once

#include <QDialog>
#include <QLabel>
#include <QLineEdit>

#include "client/gui/link/link.h"

namespace metamer::gui {

/// Which server: how things stand with it, what it says of itself, and the way to another one.
class ServerDialog : public QDialog {
  Q_OBJECT
 public:
  ServerDialog(Link& link, QWidget* parent);

 private:
  void show_status();

  Link& link_;
  QLabel *status_, *info_;
  QLineEdit* address_;
};

}  // namespace metamer::gui
