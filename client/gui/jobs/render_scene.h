#pragma once

#include <functional>

#include "client/gui/app/main_window.h"
#include "client/gui/jobs/job_page.h"

namespace metamer::gui {

/// What the panel of a page says is written into the window's log.
template <class Page>
void log_page(MainWindow& window, const Page& page) {
  QObject::connect(&page.panel(), &JobPanel::said, &window,
                   [&window, &page](LogKind kind, const QString& text) {
                     window.log().write(kind, page.name(), text);
                   });
}

/// Renders a scene in a page of its own, which is shown. Its files are `assets`.
JobPage* render_scene(MainWindow& window, const std::shared_ptr<const v1::Scene>& scene,
                      const std::vector<Asset>& assets, const QString& name);
/// Shows a job of the server's: in the page that it has, else in a new one.
JobPage* show_job(MainWindow& window, const client::JobHandle& job, const QString& name);

/// Does it when the newest text of the scene in front is checked: at once, or as soon as it is.
void when_checked(MainWindow& window, const std::function<void()>& done);

/// The scene in front as it looks now, ready to be sent. Nothing, and the window says why: there is
/// none, it has problems, there is no server.
struct Sendable {
  std::shared_ptr<const v1::Scene> scene;
  std::vector<Asset> assets;
  QString name;
};
std::optional<Sendable> sendable(MainWindow& window);

}  // namespace metamer::gui
