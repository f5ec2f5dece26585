#pragma once

#include <QDialog>
#include <QLineEdit>
#include <QListWidget>

#include "client/gui/app/actions.h"

namespace metamer::gui {

/// Every action that can be chosen now, by a few letters of its name: all words have to be in it.
class Palette : public QDialog {
  Q_OBJECT
 public:
  Palette(const Actions& actions, QWidget* parent);

  QLineEdit& words() { return *words_; }
  QListWidget& list() { return *list_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void show_matches();
  void choose();

  const Actions& actions_;
  QLineEdit* words_;
  QListWidget* list_;
};

}  // namespace metamer::gui
