#pragma once

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// The spectra manager and "Make a metamer", from the menu Spectra.
void add_spectra(MainWindow& window);

}  // namespace metamer::gui
