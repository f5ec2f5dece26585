#include "client/gui/problems/fix_delegate.h"

#include <QApplication>
#include <QMouseEvent>
#include <QPainter>

namespace metamer::gui {
namespace {

QStyleOptionButton button_of(const QStyleOptionViewItem& option, const QModelIndex& index) {
  QStyleOptionButton button;
  button.text = index.data().toString();
  button.rect = option.rect.adjusted(1, 1, -1, -1);
  button.palette = option.palette;
  button.fontMetrics = option.fontMetrics;
  button.state = QStyle::State_Enabled | QStyle::State_Raised;
  if (option.state.testFlag(QStyle::State_MouseOver)) button.state |= QStyle::State_MouseOver;
  return button;
}

}  // namespace

void FixDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option,
                        const QModelIndex& index) const {
  QStyleOptionViewItem bare = option;
  initStyleOption(&bare, index);
  const QString text = bare.text;
  bare.text.clear();
  const QStyle& style = option.widget != nullptr ? *option.widget->style() : *QApplication::style();
  style.drawControl(QStyle::CE_ItemViewItem, &bare, painter, option.widget);
  if (text.isEmpty()) return;
  const QStyleOptionButton button = button_of(option, index);
  style.drawControl(QStyle::CE_PushButton, &button, painter, option.widget);
}

QSize FixDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const {
  const QSize text = QStyledItemDelegate::sizeHint(option, index);
  return {text.width() + 16, text.height()};
}

bool FixDelegate::editorEvent(QEvent* event, QAbstractItemModel*,
                              const QStyleOptionViewItem& option, const QModelIndex& index) {
  if (event->type() != QEvent::MouseButtonRelease || index.data().toString().isEmpty())
    return false;
  const auto& mouse = static_cast<const QMouseEvent&>(*event);
  if (mouse.button() != Qt::LeftButton || !option.rect.contains(mouse.pos())) return false;
  Q_EMIT clicked(index.row());
  return true;
}

}  // namespace metamer::gui
