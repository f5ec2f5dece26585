#include "client/gui/app/add_app.h"

#include <QApplication>
#include <QDir>
#include <QFileInfo>
#include <QMessageBox>

#include "client/gui/app/keys_page.h"
#include "client/gui/app/palette.h"
#include "client/gui/app/server_dialog.h"

namespace metamer::gui {
namespace {

/// A pane that takes no focus itself gives it to its first part that does.
void give_focus(QWidget& pane) {
  QWidget* to = &pane;
  while (to->focusPolicy() == Qt::NoFocus && to->focusProxy() == nullptr) {
    do {
      to = to->nextInFocusChain();
    } while (to != &pane && !(pane.isAncestorOf(to) && to->isVisible() && to->isEnabled()));
    if (to == &pane) return;
  }
  to->setFocus(Qt::ShortcutFocusReason);
}

/// The parts of the window that have the focus one after the other: scene, picture, docks.
void focus_pane(MainWindow& window, int by) {
  QList<QWidget*> panes;
  for (QWidget* pane : {window.scenes().currentWidget(), window.pictures().currentWidget()})
    if (pane != nullptr) panes << pane;
  for (QDockWidget* dock : window.findChildren<QDockWidget*>())
    if (dock->isVisible() && !dock->visibleRegion().isEmpty()) panes << dock->widget();
  if (panes.isEmpty()) return;
  qsizetype at = by > 0 ? -1 : 0;
  for (qsizetype i = 0; i < panes.size(); ++i)
    if (panes[i]->isAncestorOf(QApplication::focusWidget()) ||
        panes[i] == QApplication::focusWidget())
      at = i;
  give_focus(*panes[(at + by + panes.size()) % panes.size()]);
}

const char* about_text() {
  return QT_TRANSLATE_NOOP(
      "About",
      "A window on a spectral render service: how a paint, a textile or a coating looks under "
      "daylight, tungsten and fluorescents.\n\n"
      "This program is under the GPL-3, as QScintilla and QCustomPlot in it are; its own sources "
      "are "
      "under the Apache License 2.0.");
}

}  // namespace

QString find_booth() {
  const QDir programs(QCoreApplication::applicationDirPath());
  for (const char* place :
       {"../../../deploy/booth/booth.txtpb", "../share/metamer/booth/booth.txtpb"}) {
    const QFileInfo file(programs.filePath(QString::fromUtf8(place)));
    if (file.isReadable()) return file.canonicalFilePath();
  }
  return {};
}

void add_app(MainWindow& window) {
  Actions& actions = window.actions();
  actions.bind(QStringLiteral("file.booth"), [&window] {
    const QString booth = find_booth();
    booth.isEmpty() ? window.say(MainWindow::tr("the demo booth is not installed"))
                    : window.open(booth);
  });
  actions.bind(QStringLiteral("window.next_pane"), [&window] { focus_pane(window, 1); });
  actions.bind(QStringLiteral("window.previous_pane"), [&window] { focus_pane(window, -1); });
  actions.bind(QStringLiteral("help.palette"), [&window] {
    auto* palette = new Palette(window.actions(), &window);
    palette->setAttribute(Qt::WA_DeleteOnClose);
    palette->open();
  });
  actions.bind(QStringLiteral("help.keys"), [&window] {
    window.show_picture(make_keys_page(window.actions()), MainWindow::tr("Keys"));
  });
  actions.bind(QStringLiteral("help.server"), [&window] {
    auto* dialog = new ServerDialog(window.link(), &window);
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
  });
  actions.bind(QStringLiteral("help.about"), [&window] {
    QMessageBox::about(&window, MainWindow::tr("Metamer %1").arg(QStringLiteral(METAMER_VERSION)),
                       QCoreApplication::translate("About", about_text()));
  });
}

}  // namespace metamer::gui
