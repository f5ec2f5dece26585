#pragma once

#include <QFileSystemWatcher>
#include <QSet>
#include <QTimer>

namespace metamer::gui {

/// Watches files, also those that are put in the place of one, or are not there yet: as programs
/// save, by another file that takes the name, or a moment after the old one went.
class DiskWatch : public QObject {
  Q_OBJECT
 public:
  explicit DiskWatch(QObject* parent = nullptr);

  /// These from now on, and no others.
  void set_files(const QStringList& paths);

  /// Changes are gathered for so long, and told together.
  static constexpr std::chrono::milliseconds gathering{200};

 Q_SIGNALS:
  /// Files whose content may be another, have come, or have gone.
  void changed(const QStringList& paths);

 private:
  void look_soon();
  void look();
  void watch();

  QFileSystemWatcher watcher_;
  QTimer timer_;
  QStringList paths_;
  QSet<QString> missing_, touched_;
};

}  // namespace metamer::gui
