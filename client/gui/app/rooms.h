#pragma once

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// Lets each room make its docks and pages in the window and bind its actions: a line each.
void add_rooms(MainWindow& window);

}  // namespace metamer::gui
