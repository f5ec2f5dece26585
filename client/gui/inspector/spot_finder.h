#pragma once

#include <QPointer>

#include "client/gui/app/main_window.h"
#include "client/gui/inspector/inspector.h"

namespace metamer::gui {

/// Finds out what is under the cursor, in whichever picture is in front: by a probe of a live view,
/// from X Y Z and factors of a picture that is complete. The newest question is what counts.
class SpotFinder : public QObject {
  Q_OBJECT
 public:
  SpotFinder(MainWindow& window, Inspector& inspector);

  /// Keeps what is under the cursor.
  void pin();

 private:
  void follow_page();
  void hover(const std::optional<QPoint>& pixel);
  void look_again();
  void look_at(const Picture& picture);
  void take(const client::ViewPlace& place, const v1::Probed& probed);
  void show_marks();
  void show_whether_known();
  void go_to_object(const QString& name);
  LivePage* live() const;

  /// A pin's place in the page that it was set in.
  struct Mark {
    int pin;
    QPointer<PicturePage> page;
    QPointF place;       ///< Shares of the picture's size.
    std::string camera;  ///< Of a live view: seen by another one it is elsewhere.
  };

  MainWindow& window_;
  Inspector& inspector_;
  QPointer<PicturePage> page_;
  QPointer<Document> document_;  ///< Of a live page.
  std::optional<QPoint> pixel_;  ///< Under the cursor, or where it was last.
  QSize size_;                   ///< Of the picture that the spot is in.
  QList<Mark> marks_;
  unsigned asked_ = 0;
};

}  // namespace metamer::gui
