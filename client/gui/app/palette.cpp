#include "client/gui/app/palette.h"

#include <QKeyEvent>
#include <QVBoxLayout>

namespace metamer::gui {

Palette::Palette(const Actions& actions, QWidget* parent)
    : QDialog(parent), actions_(actions), words_(new QLineEdit), list_(new QListWidget) {
  setWindowTitle(tr("Commands"));
  resize(520, 420);
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(words_);
  layout->addWidget(list_);
  words_->setPlaceholderText(tr("What do you want to do?"));
  words_->setAccessibleName(tr("Words of a command"));
  list_->setAccessibleName(tr("Commands"));
  words_->installEventFilter(this);
  connect(words_, &QLineEdit::textChanged, this, &Palette::show_matches);
  connect(words_, &QLineEdit::returnPressed, this, &Palette::choose);
  connect(list_, &QListWidget::itemActivated, this, &Palette::choose);
  show_matches();
}

void Palette::show_matches() {
  list_->clear();
  const QStringList words = words_->text().split(QLatin1Char(' '), Qt::SkipEmptyParts);
  for (const ActionRow& row : action_table()) {
    QAction* action = actions_[QString::fromUtf8(row.id)];
    if (!action->isEnabled() || qstrcmp(row.id, "help.palette") == 0) continue;
    const QString name =
        QString::fromUtf8(row.menu).replace(QLatin1Char('/'), QStringLiteral(" ▸ ")) +
        QStringLiteral(" ▸ ") + action->text().remove(QLatin1Char('&'));
    const bool fits = std::all_of(words.begin(), words.end(), [&](const QString& word) {
      return name.contains(word, Qt::CaseInsensitive);
    });
    if (!fits) continue;
    const QString key = action->shortcut().toString(QKeySequence::NativeText);
    auto* item =
        new QListWidgetItem(key.isEmpty() ? name : name + QStringLiteral("    ") + key, list_);
    item->setData(Qt::UserRole, QString::fromUtf8(row.id));
  }
  list_->setCurrentRow(0);
}

void Palette::choose() {
  const QListWidgetItem* item = list_->currentItem();
  if (item == nullptr) return;
  QAction* action = actions_[item->data(Qt::UserRole).toString()];
  accept();
  action->trigger();
}

bool Palette::eventFilter(QObject* watched, QEvent* event) {
  if (watched == words_ && event->type() == QEvent::KeyPress) {
    const int key = static_cast<QKeyEvent*>(event)->key();
    if (key == Qt::Key_Down || key == Qt::Key_Up) {
      const int rows = list_->count();
      if (rows > 0)
        list_->setCurrentRow((list_->currentRow() + (key == Qt::Key_Down ? 1 : rows - 1)) % rows);
      return true;
    }
  }
  return QDialog::eventFilter(watched, event);
}

}  // namespace metamer::gui
