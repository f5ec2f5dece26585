#pragma once

#include <QBoxLayout>
#include <QPushButton>

namespace metamer::gui {

/// A button at the end of a row that does `done` of its receiver; Return in a field does not press
/// it.
template <class Receiver, class Done>
QPushButton* add_button(QBoxLayout& row, const QString& words, Receiver* receiver, Done done) {
  auto* made = new QPushButton(words);
  made->setAutoDefault(false);
  QObject::connect(made, &QPushButton::clicked, receiver, done);
  row.addWidget(made);
  return made;
}

}  // namespace metamer::gui
