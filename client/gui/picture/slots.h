#pragma once

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// The pictures of one document, in their tabs' order, are its slots: shows the one `by` further,
/// around the end, as it is zoomed and shifted now.
void flick(MainWindow& window, int by);

}  // namespace metamer::gui
