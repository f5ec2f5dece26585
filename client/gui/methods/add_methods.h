#pragma once

namespace metamer::gui {

class MainWindow;

/// The dock of methods, by cost and error.
void add_methods(MainWindow& window);

}  // namespace metamer::gui
