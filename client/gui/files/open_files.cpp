#include "client/gui/files/open_files.h"

#include <QFileInfo>
#include <QSettings>

#include "client/gui/app/main_window.h"

namespace metamer::gui {
namespace {

constexpr std::chrono::seconds gathering{1};

QString open_key() { return QStringLiteral("open"); }
QString path_key() { return QStringLiteral("path"); }
QString scene_key() { return QStringLiteral("scene"); }
QString front_key() { return QStringLiteral("front"); }

}  // namespace

OpenFiles::OpenFiles(MainWindow& window) : QObject(&window), window_(window) {
  timer_.setSingleShot(true);
  timer_.setInterval(gathering);
  connect(&timer_, &QTimer::timeout, this, &OpenFiles::keep);
  connect(&window, &MainWindow::document_chosen, &timer_, qOverload<>(&QTimer::start));
  connect(&window, &MainWindow::closing, this, &OpenFiles::keep);
}

void OpenFiles::keep() {
  timer_.stop();
  QSettings settings;
  settings.remove(open_key());
  settings.beginWriteArray(open_key());
  int at = 0;
  for (const TextFile* file : window_.files()) {
    if (file->path().isEmpty()) continue;
    settings.setArrayIndex(at++);
    settings.setValue(path_key(), QFileInfo(file->path()).absoluteFilePath());
    settings.setValue(scene_key(), qobject_cast<const Document*>(file) != nullptr);
  }
  settings.endArray();
  const TextFile* front = window_.file();
  settings.setValue(front_key(),
                    front == nullptr ? QString() : QFileInfo(front->path()).absoluteFilePath());
}

bool open_last_files(MainWindow& window) {
  QSettings settings;
  const QString front = settings.value(front_key()).toString();
  const int count = settings.beginReadArray(open_key());
  for (int i = 0; i < count; ++i) {
    settings.setArrayIndex(i);
    const QString path = settings.value(path_key()).toString();
    if (!QFileInfo(path).isReadable()) continue;
    settings.value(scene_key()).toBool() ? window.open(path) : void(window.open_text(path));
  }
  for (TextFile* file : window.files())
    if (QFileInfo(file->path()).absoluteFilePath() == front) window.show_text(file);
  if (window.live() != nullptr) window.show_picture(window.live(), {});
  return !window.files().isEmpty();
}

}  // namespace metamer::gui
