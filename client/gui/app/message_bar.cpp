#include "client/gui/app/message_bar.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <utility>

namespace metamer::gui {

MessageBar::MessageBar(const QString& sentence, QWidget* parent)
    : QWidget(parent), row_(new QHBoxLayout(this)) {
  setAccessibleName(sentence);
  setAutoFillBackground(true);
  setBackgroundRole(QPalette::ToolTipBase);
  row_->setContentsMargins(8, 4, 4, 4);
  auto* label = new QLabel(sentence);
  label->setWordWrap(true);
  label->setForegroundRole(QPalette::ToolTipText);
  row_->addWidget(label, 1);
}

void MessageBar::add_answer(const QString& text, std::function<void()> done) {
  auto* button = new QPushButton(text);
  button->setAutoDefault(false);
  row_->addWidget(button);
  connect(button, &QPushButton::clicked, this, [this, done = std::move(done)] {
    hide();
    deleteLater();
    if (done) done();
  });
}

}  // namespace metamer::gui
