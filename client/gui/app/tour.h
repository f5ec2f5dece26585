#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QString>
#include <QTimer>
#include <QWidget>
#include <vector>

namespace metamer::gui {

class MainWindow;

/// One page: the actions that are chosen and the docks that are shown, one after the other, and how
/// long it may take to come.
struct TourStep {
  const char* name;
  std::vector<const char*> ids;
  int wait = 1500;     ///< ms
  bool point = false;  ///< At a place of the live picture.
};

const std::vector<TourStep>& tour_steps();
void take_step(MainWindow& window, const TourStep& step);

/// Another window or dialog than the main window, where one is open; else that.
QWidget& front_window(MainWindow& window);

/// Goes through the window's pages and writes each as FOLDER/NAME.png, to be looked at; then ends
/// the program. Its steps are a table; each waits for a while. Prints how long the window's thread
/// stood still in each, at most.
class Tour : public QObject {
  Q_OBJECT
 public:
  Tour(MainWindow& window, QString folder);
  void start();

 private:
  void go_on();
  void grab();

  MainWindow& window_;
  QString folder_;
  std::size_t step_ = 0;
  QTimer beat_;  ///< Shows how long the window's thread was busy.
  QElapsedTimer between_;
  qint64 longest_ = 0;  ///< ms between two beats of this step.
};

}  // namespace metamer::gui
