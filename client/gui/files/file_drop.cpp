#include "client/gui/files/file_drop.h"

#include <QDropEvent>
#include <QMimeData>
#include <QUrl>
#include <utility>

namespace metamer::gui {

QStringList dropped_scenes(const QMimeData& data) {
  QStringList scenes;
  for (const QUrl& url : data.urls()) {
    if (!url.isLocalFile() || !url.path().endsWith(QStringLiteral(".txtpb"))) return {};
    scenes << url.toLocalFile();
  }
  return scenes;
}

FileDrop::FileDrop(QObject* parent, std::function<void(const QString&)> open)
    : QObject(parent), open_(std::move(open)) {}

bool FileDrop::eventFilter(QObject* watched, QEvent* event) {
  const auto type = event->type();
  if (type != QEvent::DragEnter && type != QEvent::DragMove && type != QEvent::Drop)
    return QObject::eventFilter(watched, event);
  auto& drop = static_cast<QDropEvent&>(*event);
  const QStringList scenes = dropped_scenes(*drop.mimeData());
  if (scenes.isEmpty()) return QObject::eventFilter(watched, event);
  drop.setDropAction(Qt::CopyAction);
  drop.accept();
  if (type == QEvent::Drop)
    for (const QString& scene : scenes) open_(scene);
  return true;
}

}  // namespace metamer::gui
