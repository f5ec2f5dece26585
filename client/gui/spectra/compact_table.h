#pragma once

#include <QHeaderView>
#include <QTableView>

namespace metamer::gui {

/// Rows as high as their text, without numbers; Tab leaves the table, arrows move in it.
inline void make_compact(QTableView& view) {
  view.verticalHeader()->hide();
  view.verticalHeader()->setDefaultSectionSize(view.fontMetrics().height() + 6);
  view.setTabKeyNavigation(false);
}

}  // namespace metamer::gui
