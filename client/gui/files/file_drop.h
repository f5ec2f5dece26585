#pragma once

#include <QObject>
#include <QStringList>
#include <functional>

class QMimeData;

namespace metamer::gui {

/// Lets scenes that are dropped onto the objects that it filters be opened. Other drops are theirs.
class FileDrop : public QObject {
  Q_OBJECT
 public:
  FileDrop(QObject* parent, std::function<void(const QString&)> open);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  std::function<void(const QString&)> open_;
};

/// The files of a drop, if all are scenes of this machine; else none.
QStringList dropped_scenes(const QMimeData& data);

}  // namespace metamer::gui
