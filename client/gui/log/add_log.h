#pragma once

namespace metamer::gui {

class MainWindow;

/// The dock of the log, and the lines that the server's state gives.
void add_log(MainWindow& window);

}  // namespace metamer::gui
