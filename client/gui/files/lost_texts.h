#pragma once

#include <QString>

namespace metamer::gui {

class MainWindow;

/// Where texts that are not saved are kept.
QString unsaved_folder();

/// Asks whether to open what runs that ended by themselves have left in `root`; nothing where
/// nothing is left. Returns at once.
void offer_lost_texts(MainWindow& window, const QString& root);

}  // namespace metamer::gui
