#pragma once

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// How pictures are looked at, and the flick from one to the next.
void add_picture(MainWindow& window);

}  // namespace metamer::gui
