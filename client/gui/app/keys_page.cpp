#include "client/gui/app/keys_page.h"

#include <QHeaderView>

namespace metamer::gui {

QTableWidget* make_keys_page(const Actions& actions, QWidget* parent) {
  const auto rows = action_table();
  auto* table = new QTableWidget(static_cast<int>(rows.size()), 3, parent);
  table->setHorizontalHeaderLabels({QObject::tr("Menu"), QObject::tr("What"), QObject::tr("Keys")});
  table->setAccessibleName(QObject::tr("Keys"));
  table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  table->setSelectionBehavior(QAbstractItemView::SelectRows);
  table->verticalHeader()->hide();
  table->setTabKeyNavigation(false);
  int at = 0;
  for (const ActionRow& row : rows) {
    const QAction* action = actions[QString::fromUtf8(row.id)];
    const QString menu =
        QString::fromUtf8(row.menu).replace(QLatin1Char('/'), QStringLiteral(" ▸ "));
    const QString keys = QKeySequence::listToString(action->shortcuts(), QKeySequence::NativeText)
                             .replace(QStringLiteral("; "), QObject::tr(" or "));
    table->setItem(at, 0, new QTableWidgetItem(menu));
    table->setItem(at, 1, new QTableWidgetItem(action->text().remove(QLatin1Char('&'))));
    table->setItem(at, 2,
                   new QTableWidgetItem(row.context == Context::picture && !keys.isEmpty()
                                            ? QObject::tr("%1 (in a picture)").arg(keys)
                                            : keys));
    ++at;
  }
  table->resizeColumnsToContents();
  table->horizontalHeader()->setStretchLastSection(true);
  return table;
}

}  // namespace metamer::gui
