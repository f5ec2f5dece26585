#include "client/gui/files/disk_watch.h"

#include <QFileInfo>

namespace metamer::gui {

DiskWatch::DiskWatch(QObject* parent) : QObject(parent) {
  timer_.setSingleShot(true);
  timer_.setInterval(gathering);
  connect(&timer_, &QTimer::timeout, this, &DiskWatch::look);
  connect(&watcher_, &QFileSystemWatcher::fileChanged, this, [this](const QString& path) {
    touched_ << path;
    look_soon();
  });
  connect(&watcher_, &QFileSystemWatcher::directoryChanged, this, &DiskWatch::look_soon);
}

/// A folder where much goes on must not put it off for ever.
void DiskWatch::look_soon() {
  if (!timer_.isActive()) timer_.start();
}

void DiskWatch::set_files(const QStringList& paths) {
  if (paths == paths_) return;
  paths_ = paths;
  QStringList unwanted;
  for (const QString& path : watcher_.files())
    if (!paths_.contains(path)) unwanted << path;
  if (!unwanted.isEmpty()) watcher_.removePaths(unwanted);
  watch();
  missing_.clear();
  for (const QString& path : paths_)
    if (!QFileInfo::exists(path)) missing_ << path;
}

/// A file that has gone is no longer watched; its folder tells when it comes again.
void DiskWatch::watch() {
  const QStringList files = watcher_.files(), folders = watcher_.directories();
  QStringList wanted;
  for (const QString& path : paths_) {
    const QFileInfo file(path);
    if (file.exists() && !files.contains(path)) wanted << path;
    const QString folder = file.absolutePath();
    if (QFileInfo::exists(folder) && !folders.contains(folder) && !wanted.contains(folder))
      wanted << folder;
  }
  if (!wanted.isEmpty()) watcher_.addPaths(wanted);
}

void DiskWatch::look() {
  // What is watched is a file and not its name, which may be another file's by now.
  const QStringList files = watcher_.files();
  for (const QString& path : touched_)
    if (files.contains(path)) watcher_.removePath(path);
  watch();
  QStringList told;
  for (const QString& path : paths_) {
    const bool there = QFileInfo::exists(path);
    const bool came_or_went = there == missing_.contains(path);
    if (came_or_went || touched_.contains(path)) told << path;
    if (there)
      missing_.remove(path);
    else
      missing_ << path;
  }
  touched_.clear();
  if (!told.isEmpty()) Q_EMIT changed(told);
}

}  // namespace metamer::gui
