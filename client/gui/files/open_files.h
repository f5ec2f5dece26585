#pragma once

#include <QObject>
#include <QTimer>

namespace metamer::gui {

class MainWindow;

/// Keeps in the program's settings which files are open, for its next start.
class OpenFiles : public QObject {
  Q_OBJECT
 public:
  explicit OpenFiles(MainWindow& window);

  void keep();

 private:
  MainWindow& window_;
  QTimer timer_;  ///< Changes come several at a time.
};

/// Opens what was open when the program ended, as far as it is still there. False: nothing was.
bool open_last_files(MainWindow& window);

}  // namespace metamer::gui
