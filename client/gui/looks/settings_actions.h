#pragma once

#include <QStringList>

#include "client/gui/app/main_window.h"

/// Settings that are chosen from a list: device and lighting, observer and adaptation. Each word is
/// an action of the window's table.
namespace metamer::gui {

/// The actions of one list, by id, in the order of the schema's enumeration.
struct ChoiceMenu {
  QString name;
  QStringList actions;
};
QList<ChoiceMenu> choice_menus();

/// Binds them: each is a command on the undo stack of the document in front.
void bind_settings(MainWindow& window);
/// Checks the actions that `settings` choose.
void check_settings(const v1::Settings& settings, Actions& actions);

}  // namespace metamer::gui
