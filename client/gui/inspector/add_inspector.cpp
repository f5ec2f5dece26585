#include "client/gui/inspector/add_inspector.h"

#include "client/gui/inspector/spot_finder.h"

namespace metamer::gui {

void add_inspector(MainWindow& window) {
  auto* inspector = new Inspector;
  QDockWidget* dock = window.add_dock(QStringLiteral("inspector"), MainWindow::tr("Inspector"),
                                      inspector, Qt::RightDockWidgetArea);
  auto* finder = new SpotFinder(window, *inspector);
  window.actions().bind(QStringLiteral("light.pin"), [dock, finder] {
    if (!dock->isVisible()) return dock->show();  // what is under the cursor is asked for then
    finder->pin();
  });
}

}  // namespace metamer::gui
