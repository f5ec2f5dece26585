#pragma once

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// The actions of a live view: on and off, its camera by keys, and what stands over it.
void add_live(MainWindow& window);

}  // namespace metamer::gui
