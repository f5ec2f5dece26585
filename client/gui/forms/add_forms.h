#pragma once

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// Settings: the form of what a render, or the live view, goes by.
void add_forms(MainWindow& window);

}  // namespace metamer::gui
