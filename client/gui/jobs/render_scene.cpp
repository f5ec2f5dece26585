#include "client/gui/jobs/render_scene.h"

#include "client/gui/jobs/jobs_dock.h"

namespace metamer::gui {
namespace {

JobPage* add_page(MainWindow& window) {
  auto* page = new JobPage(window.link());
  log_page(window, *page);
  QObject::connect(page, &JobPage::titled, &window, [&window, page] {
    if (const int at = window.pictures().indexOf(page); at >= 0)
      window.pictures().setTabText(at, page->title());
  });
  QObject::connect(page, &JobPage::exact_asked, &window, [&window, page] {
    if (const auto picture = page->picture(); picture && picture->scene) {
      auto exact = std::make_shared<v1::Scene>(*picture->scene);
      exact->mutable_settings()->clear_goal();
      exact->mutable_settings()->mutable_method()->mutable_exact();
      render_scene(window, exact, page->assets(), picture->title);
    }
  });
  return page;
}

}  // namespace

void when_checked(MainWindow& window, const std::function<void()>& done) {
  Document* document = window.document();
  if (document == nullptr || document->settled()) return done();
  document->check_now();
  auto* once = new QObject(document);
  QObject::connect(document, &Document::checked_changed, once, [&window, document, once, done] {
    if (!document->settled()) return;
    once->deleteLater();
    // Another scene came to the front meanwhile: nobody asked for that one.
    if (window.document() == document) done();
  });
}

std::optional<Sendable> sendable(MainWindow& window) {
  const Document* document = window.document();
  if (document == nullptr) return std::nullopt;
  const auto refuse = [&](const QString& why) {
    window.say(why);
    return std::nullopt;
  };
  if (!window.link().ready()) return refuse(QObject::tr("there is no server"));
  if (!document->checked() || !document->checked()->sound())
    return refuse(QObject::tr("the scene has problems"));
  Result<v1::Scene> scene = document->effective();
  if (!scene) return refuse(QString::fromStdString(scene.error().message));
  return Sendable{.scene = std::make_shared<const v1::Scene>(std::move(*scene)),
                  .assets = document->sound()->assets(),
                  .name = document->title()};
}

JobPage* render_scene(MainWindow& window, const std::shared_ptr<const v1::Scene>& scene,
                      const std::vector<Asset>& assets, const QString& name) {
  JobPage* page = add_page(window);
  QObject::connect(page, &JobPage::sent, &window, [&window, page] {
    if (auto* jobs = window.findChild<JobsDock*>()) {
      jobs->table().add_own(page->job());
      if (jobs->isVisible()) jobs->update_now();
    }
  });
  page->set_subject(window.document());
  page->render(scene, assets, name);
  window.show_picture(page, page->title());
  return page;
}

JobPage* show_job(MainWindow& window, const client::JobHandle& job, const QString& name) {
  for (int i = 0; i < window.pictures().count(); ++i)
    if (auto* there = qobject_cast<JobPage*>(window.pictures().widget(i));
        there != nullptr && there->job() == job) {
      window.show_picture(there, there->title());
      return there;
    }
  JobPage* page = add_page(window);
  page->watch(job, name);
  window.show_picture(page, page->title());
  return page;
}

}  // namespace metamer::gui
