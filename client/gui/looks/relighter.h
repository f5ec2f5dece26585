#pragma once

#include <QPointer>

#include "client/gui/app/main_window.h"
#include "client/gui/jobs/job_page.h"

namespace metamer::gui {

/// Shows the finished picture in front under the look of the scene in front, from its factors: no
/// server is asked. Rays are not traced: another camera or another object leaves it as it was
/// rendered, but a camera that was moved by hand is that of the live view alone.
class Relighter : public QObject {
  Q_OBJECT
 public:
  explicit Relighter(MainWindow& window);

 private:
  void follow();
  void follow_document();
  void relight();

  MainWindow& window_;
  QPointer<Document> document_;
  QPointer<JobPage> page_;
  unsigned asked_ = 0;  ///< The newest look counts.
};

}  // namespace metamer::gui
