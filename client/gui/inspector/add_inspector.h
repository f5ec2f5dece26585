#pragma once

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// What is under the cursor, in a dock, and pins.
void add_inspector(MainWindow& window);

}  // namespace metamer::gui
