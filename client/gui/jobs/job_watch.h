#pragma once

#include <QImage>
#include <QList>
#include <QObject>
#include <QPoint>
#include <QSize>
#include <memory>

#include "client/gui/link/link.h"

namespace metamer::gui {

/// While a picture grows, one pixel of the screen's stands for a square of so many of its own on a
/// side, that even the largest takes no more than 16 MiB.
int growth_side(const QSize& picture);
/// The size of what is shown of it.
QSize grown_size(const QSize& picture);

/// A finished part of a picture, as a screen shows it while it grows.
struct ShownTile {
  QPoint corner;
  QImage image;  ///< RGB32
};

/// A job that is watched from its first event to its last, for the window's thread. Its picture is
/// kept and developed on the session's thread, and comes from there at most 30 times a second; at
/// the end the record comes as a whole. The watch ends with its object; the job goes on.
class JobWatch : public QObject {
  Q_OBJECT
 public:
  JobWatch(Link& link, client::JobHandle job, client::JobParts parts, QObject* parent);

 Q_SIGNALS:
  /// All but tiles and previews. Planned: the picture begins anew.
  void event(const std::shared_ptr<const v1::JobEvent>& event);
  void grew(const QList<ShownTile>& tiles);
  /// One of these is the last.
  void ended(const std::shared_ptr<client::JobRecord>& record);
  void lost(const std::shared_ptr<const client::SessionError>& error);
};

}  // namespace metamer::gui
