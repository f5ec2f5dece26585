#pragma once

#include <QString>
#include <QTemporaryDir>
#include <functional>

#include "client/gui/app/main_window.h"
#include "client/gui/jobs/job_page.h"

/// A window with a server of its own and a scene, for tests of what it does with jobs.
namespace metamer::test {

/// Whether it comes true within `seconds`; the window's events go on meanwhile.
bool comes(const std::function<bool()>& condition, int seconds = 60);

/// A picture for a blink, with these settings.
std::string blink_scene(const std::string& settings);

class JobsWindow {
 public:
  /// Shows the scene, whose check is waited for, on a private server that is there; "bad.ply" lies
  /// beside it, and is no mesh.
  explicit JobsWindow(const std::string& scene);

  gui::MainWindow& window() { return window_; }
  gui::Document& document() { return *window_.document(); }
  /// Where the scene lies; files beside it go with it.
  QString path(const QString& name) const { return folder_.filePath(name); }
  /// Chooses an action that has to be there.
  void choose(const char* action);
  /// The page that is in front; null and a failure: it shows no job.
  gui::JobPage* job();

 private:
  void write(const QString& name, const std::string& text);

  QTemporaryDir folder_;
  gui::Link link_;
  gui::MainWindow window_{link_};
};

}  // namespace metamer::test
