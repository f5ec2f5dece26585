#pragma once

#include <QApplication>

namespace metamer::gui {

/// Dark colours by Qt's own Fusion style, for a desktop that has none.
void set_dark(QApplication& application);

}  // namespace metamer::gui
