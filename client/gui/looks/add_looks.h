#pragma once

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// The room of light and paint: the bar of looks, and what the Light menu does.
void add_looks(MainWindow& window);

}  // namespace metamer::gui
