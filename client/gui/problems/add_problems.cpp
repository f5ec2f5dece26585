#include "client/gui/problems/add_problems.h"

#include "client/gui/app/main_window.h"
#include "client/gui/problems/problems_dock.h"

namespace metamer::gui {

void add_problems(MainWindow& window) {
  auto* dock = new ProblemsDock(window);
  QDockWidget* frame = window.add_dock(QStringLiteral("problems"), ProblemsDock::tr("Problems"),
                                       dock, Qt::BottomDockWidgetArea);
  QObject::connect(dock, &ProblemsDock::counted, frame, [frame](int problems) {
    frame->setWindowTitle(problems == 0 ? ProblemsDock::tr("Problems")
                                        : ProblemsDock::tr("Problems (%1)").arg(problems));
  });
  window.actions().bind(QStringLiteral("edit.next_problem"), [dock] { dock->step(false); });
  window.actions().bind(QStringLiteral("edit.previous_problem"), [dock] { dock->step(true); });
  window.actions().bind(QStringLiteral("edit.fix"), [dock] { dock->fix_here(); });
}

}  // namespace metamer::gui
