#include "client/gui/jobs/add_jobs.h"

#include <QStatusBar>

#include "client/gui/jobs/check_page.h"
#include "client/gui/jobs/jobs_dock.h"
#include "client/gui/jobs/quit_question.h"
#include "client/gui/jobs/render_scene.h"
#include "client/gui/jobs/save_picture.h"

namespace metamer::gui {
namespace {

void add_jobs_dock(MainWindow& window) {
  auto* jobs = new JobsDock(window.link());
  QObject::connect(jobs, &JobsDock::open_asked, &window,
                   [&window](const client::JobHandle& job, const QString& name) {
                     show_job(window, job, name);
                   });
  // It is opened by who wants to know of others' jobs: one's own have pages.
  window.add_dock(QStringLiteral("jobs"), JobsDock::tr("Jobs"), jobs, Qt::BottomDockWidgetArea)
      ->hide();
}

/// A page of the stages and their times; the stage stands in the status bar while it lasts.
void check_scene(MainWindow& window) {
  const auto ready = sendable(window);
  if (!ready) return;
  auto* page = new CheckPage(window.link());
  log_page(window, *page);
  QObject::connect(page, &CheckPage::titled, &window, [&window, page] {
    if (const int at = window.pictures().indexOf(page); at >= 0)
      window.pictures().setTabText(at, page->title());
  });
  QObject::connect(page, &CheckPage::stage, &window,
                   [&window](const QString& text) { window.statusBar()->showMessage(text); });
  page->check(*ready->scene, ready->assets, ready->name);
  window.show_picture(page, page->title());
}

void save_front_picture(MainWindow& window) {
  PicturePage* page = window.picture_page();
  if (page != nullptr && page->save_own()) return;
  if (page == nullptr || page->picture_title().isEmpty())
    return window.say(MainWindow::tr("the tab in front has no finished picture"));
  page->hand_over([&window](const Picture& picture) {
    ask_to_save(window, picture, [&window](const QString& text) { window.say(text); });
  });
}

void cancel_front_job(MainWindow& window) {
  if (auto* check = qobject_cast<CheckPage*>(window.pictures().currentWidget()))
    return check->cancel();
  if (PicturePage* page = window.picture_page()) page->cancel();
}

}  // namespace

void add_jobs(MainWindow& window) {
  Actions& actions = window.actions();
  actions.bind(QStringLiteral("render.render"), [&window] {
    when_checked(window, [&window] {
      if (const auto ready = sendable(window))
        render_scene(window, ready->scene, ready->assets, ready->name);
    });
  });
  actions.bind(QStringLiteral("render.check"),
               [&window] { when_checked(window, [&window] { check_scene(window); }); });
  actions.bind(QStringLiteral("render.pause"), [&window] {
    if (PicturePage* page = window.picture_page()) page->pause();
  });
  actions.bind(QStringLiteral("render.cancel"), [&window] { cancel_front_job(window); });
  actions.bind(QStringLiteral("file.save_picture"), [&window] { save_front_picture(window); });
  QObject::connect(&window.link(), &Link::unknown_changed, &window, [&window] {
    window.actions().forbid(QStringLiteral("render.pause"),
                            window.link().unknown(QStringLiteral("Pause")));
  });
  add_jobs_dock(window);
  new QuitQuestion(window);
}

}  // namespace metamer::gui
