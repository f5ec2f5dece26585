#pragma once

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// The page of all models, from the menu Help.
void add_models(MainWindow& window);

}  // namespace metamer::gui
