#include "client/gui/spectra/add_spectra.h"

#include <QFileInfo>

#include "client/gui/spectra/spectra_window.h"

namespace metamer::gui {
namespace {

void add_scene_spectra(const MainWindow& window, SpectraWindow& spectra) {
  const Document* document = window.document();
  if (document == nullptr || !document->checked())
    return spectra.tell(SpectraWindow::tr("No scene is open."));
  const QString path = document->path();
  spectra.lists().add_scene(document->checked()->scene(),
                            path.isEmpty() ? QStringLiteral(".") : QFileInfo(path).path());
}

/// Made when it is first asked for, and then kept with its lists.
SpectraWindow& manager_of(MainWindow& window) {
  if (auto* there = window.findChild<SpectraWindow*>()) return *there;
  auto* made = new SpectraWindow(&window);
  QObject::connect(made, &SpectraWindow::scene_wanted, &window,
                   [&window, made] { add_scene_spectra(window, *made); });
  QObject::connect(&made->lists(), &SpectraLists::refused, &window, [&window](const QString& why) {
    for (const QString& line : why.split(QLatin1Char('\n')))
      window.log().write(LogKind::error, SpectraWindow::tr("spectra"), line);
  });
  QObject::connect(
      &made->lists(), &SpectraLists::added, &window, [&window](const QList<Listed>& rows) {
        for (const Listed& row : rows)
          for (const std::string& note : row->spectrum().notes)
            window.log().write(LogKind::warning, row->label(), QString::fromStdString(note));
      });
  // Something to begin with.
  if (window.document() != nullptr) add_scene_spectra(window, *made);
  return *made;
}

}  // namespace

void add_spectra(MainWindow& window) {
  window.actions().bind(QStringLiteral("spectra.manager"), [&window] {
    SpectraWindow& spectra = manager_of(window);
    spectra.show();
    spectra.activateWindow();
  });
  window.actions().bind(QStringLiteral("spectra.metamer"),
                        [&window] { manager_of(window).make_metamer(); });
}

}  // namespace metamer::gui
