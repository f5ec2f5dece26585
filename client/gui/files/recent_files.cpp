#include "client/gui/files/recent_files.h"

#include <QFileInfo>
#include <QSettings>
#include <utility>

namespace metamer::gui {
namespace {

QString settings_key() { return QStringLiteral("recent_files"); }

}  // namespace

QStringList RecentFiles::files() const { return QSettings().value(settings_key()).toStringList(); }

void RecentFiles::add(const QString& path) {
  const QString full = QFileInfo(path).absoluteFilePath();
  QStringList all = files();
  all.removeAll(full);
  all.prepend(full);
  QSettings().setValue(settings_key(), all.mid(0, most));
}

QMenu* RecentFiles::make_menu(QWidget* parent, std::function<void(const QString&)> open) {
  auto* menu = new QMenu(parent);
  connect(menu, &QMenu::aboutToShow, this, [this, menu, open = std::move(open)] {
    menu->clear();
    const QStringList all = files();
    for (int i = 0; i < all.size(); ++i) {
      // "&1 booth.txtpb — /home/me/scenes"
      const QFileInfo file(all[i]);
      const QString name = file.fileName().replace(QLatin1Char('&'), QStringLiteral("&&"));
      QAction* action = menu->addAction(QStringLiteral("%1%2 %3 — %4")
                                            .arg(i < 9 ? QStringLiteral("&") : QString())
                                            .arg(i + 1)
                                            .arg(name, file.absolutePath()));
      connect(action, &QAction::triggered, this, [path = all[i], open] { open(path); });
    }
    if (all.isEmpty()) menu->addAction(tr("No file was opened yet"))->setEnabled(false);
  });
  return menu;
}

}  // namespace metamer::gui
