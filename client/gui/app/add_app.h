#pragma once

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// The demo booth's file; empty: it lies nowhere near.
QString find_booth();

/// What belongs to the window itself: the booth, panes, the palette, keys, server and about.
void add_app(MainWindow& window);

}  // namespace metamer::gui
