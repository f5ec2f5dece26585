#pragma once

namespace metamer::gui {

class MainWindow;

/// The File menu, and what is done for each text that is open: recent files, drops, changes by
/// others, copies of what is not saved.
void add_files(MainWindow& window);

}  // namespace metamer::gui
