#pragma once

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// Compare ▸ Metamerism sheet.
void add_sheet(MainWindow& window);

}  // namespace metamer::gui
