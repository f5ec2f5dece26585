#include "client/gui/editor/find_bar.h"

#include <Qsci/qsciscintilla.h>

#include <QHBoxLayout>
#include <QKeyEvent>
#include <QPushButton>
#include <QVBoxLayout>
#include <utility>

namespace metamer::gui {
namespace {

constexpr int most_counted = 999;

}  // namespace

FindBar::FindBar(QsciScintilla* area, QWidget* parent)
    : QWidget(parent),
      area_(area),
      search_(*area),
      what_(new QLineEdit),
      by_(new QLineEdit),
      replacing_(new QWidget),
      told_(new QLabel) {
  auto* rows = new QVBoxLayout(this);
  rows->setContentsMargins(4, 4, 4, 4);
  auto* find = new QHBoxLayout;
  rows->addLayout(find);
  what_->setPlaceholderText(tr("Find"));
  what_->setAccessibleName(tr("Find"));
  find->addWidget(what_, 1);
  add_button(find, tr("&Previous"), [this] { step(true); });
  add_button(find, tr("&Next"), [this] { step(false); });
  add_button(find, tr("Close"), [this] { close_bar(); });

  rows->addWidget(replacing_);
  auto* replace = new QHBoxLayout(replacing_);
  replace->setContentsMargins(0, 0, 0, 0);
  by_->setPlaceholderText(tr("Replace by"));
  by_->setAccessibleName(tr("Replace by"));
  replace->addWidget(by_, 1);
  add_button(replace, tr("&Replace"), [this] {
    search_.replace_selected(wanted(), by_->text());
    step(false);
  });
  add_button(replace, tr("Replace &all"), [this] {
    told_->setText(tr("%n replaced", nullptr, search_.replace_all(wanted(), by_->text())));
  });

  auto* options = new QHBoxLayout;
  rows->addLayout(options);
  match_case_ = add_option(options, tr("Match &case"));
  whole_words_ = add_option(options, tr("Whole &words"));
  pattern_ = add_option(options, tr("Patte&rn"));
  options->addWidget(told_, 1);
  connect(what_, &QLineEdit::textChanged, this, &FindBar::follow);
  hide();
}

QPushButton* FindBar::add_button(QLayout* row, const QString& text, std::function<void()> done) {
  auto* button = new QPushButton(text);
  button->setAutoDefault(false);
  connect(button, &QPushButton::clicked, this, std::move(done));
  row->addWidget(button);
  return button;
}

QCheckBox* FindBar::add_option(QLayout* row, const QString& text) {
  auto* option = new QCheckBox(text);
  connect(option, &QCheckBox::toggled, this, &FindBar::follow);
  row->addWidget(option);
  return option;
}

SearchFor FindBar::wanted() const {
  return {.what = what_->text(),
          .match_case = match_case_->isChecked(),
          .whole_words = whole_words_->isChecked(),
          .pattern = pattern_->isChecked()};
}

void FindBar::open(bool replace) {
  replacing_->setVisible(replace);
  show();
  const QString selected = area_->selectedText();
  if (!selected.isEmpty() && !selected.contains(QLatin1Char('\n'))) what_->setText(selected);
  what_->selectAll();
  what_->setFocus(Qt::ShortcutFocusReason);
}

void FindBar::close_bar() {
  hide();
  area_->setFocus();
}

void FindBar::keyPressEvent(QKeyEvent* event) {
  switch (event->key()) {
    case Qt::Key_Escape:
      return close_bar();
    case Qt::Key_Return:
    case Qt::Key_Enter:
      return step(event->modifiers().testFlag(Qt::ShiftModifier));
    default:
      QWidget::keyPressEvent(event);
  }
}

void FindBar::step(bool backwards) { tell(search_.find_next(wanted(), backwards)); }

void FindBar::follow() { tell(search_.find_here(wanted())); }

void FindBar::tell(bool found) {
  if (what_->text().isEmpty()) return told_->clear();
  if (!found) return told_->setText(tr("not found"));
  const int count = search_.count(wanted(), most_counted);
  told_->setText(count < most_counted ? tr("%n found", nullptr, count)
                                      : tr("%1 or more found").arg(most_counted));
}

}  // namespace metamer::gui
