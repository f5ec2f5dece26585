#pragma once

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// The page that compares two pictures, from the menu Compare, or by a picture file that is dropped
/// onto another picture.
void add_compare(MainWindow& window);

/// Shows the page with these two and the map of their differences.
void compare_pictures(MainWindow& window, const Picture& a, const Picture& b);

}  // namespace metamer::gui
