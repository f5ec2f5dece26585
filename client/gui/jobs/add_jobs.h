#pragma once

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// Jobs: Render, Pause and Cancel, and their pages.
void add_jobs(MainWindow& window);

}  // namespace metamer::gui
