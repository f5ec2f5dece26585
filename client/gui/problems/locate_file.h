#pragma once

#include <QString>
#include <functional>

class QWidget;

namespace metamer::gui {

/// Asks for the file that a scene calls `was` and that is not in its folder. `done` gets the name
/// that the scene can give it, relative to the folder; it is not called where nothing is chosen. A
/// file from elsewhere is copied into the folder, if that is agreed to. Returns at once.
void locate_file(QWidget* parent, const QString& folder, const QString& was,
                 std::function<void(const QString& name)> done);

}  // namespace metamer::gui
