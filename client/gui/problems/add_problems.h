#pragma once

namespace metamer::gui {

class MainWindow;

/// The dock of problems, and the actions that go through them.
void add_problems(MainWindow& window);

}  // namespace metamer::gui
