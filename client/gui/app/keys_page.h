#pragma once

#include <QTableWidget>

#include "client/gui/app/actions.h"

namespace metamer::gui {

/// Every action with its menu and its keys, made of the table.
QTableWidget* make_keys_page(const Actions& actions, QWidget* parent = nullptr);

}  // namespace metamer::gui
