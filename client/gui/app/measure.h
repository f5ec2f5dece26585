#pragma once

#include <QElapsedTimer>
#include <QObject>

namespace metamer::gui {

class MainWindow;

/// What is to be measured: frames of a camera that turns, then documents that are opened, checked,
/// shown and closed, one after the other.
struct MeasureCounts {
  int frames = 0, documents = 0;
};

/// What the window costs, printed on stdout: the time to a drawn window and to the first frame;
/// over the frames, frames a second and CPU of the window's thread a frame; memory before and after
/// frames and documents. Ends the program.
class Measure : public QObject {
  Q_OBJECT
 public:
  /// `since` was started with the program.
  Measure(MainWindow& window, const QElapsedTimer& since, MeasureCounts counts);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void watch();
  void take_frame();
  void end_frames();
  void exchange_document();

  MainWindow& window_;
  QElapsedTimer since_, turning_;
  MeasureCounts counts_;
  int seen_ = 0, opened_ = 0;
  double cpu_before_ = 0;
  QString scene_;  ///< Of the documents.
  bool drawn_ = false;
};

}  // namespace metamer::gui
