#include "client/gui/sheet/sheet_base.h"

#include <algorithm>
#include <utility>

#include "client/gui/app/on_pool.h"
#include "client/gui/jobs/job_page.h"
#include "client/gui/jobs/render_scene.h"
#include "client/session/submission.h"
#include "client/tools/pictures/relit_scene.h"

namespace metamer::gui {
namespace {

/// As a sheet shows it: small, and with samples enough for smooth edges.
v1::Scene small(v1::Scene scene) {
  v1::Settings& settings = *scene.mutable_settings();
  const double wide = settings.has_width() ? settings.width() : 640;
  const double high = settings.has_height() ? settings.height() : 480;
  const double factor = std::min(1.0, client::sheet_width / wide);
  settings.set_width(static_cast<std::uint32_t>(std::max(1.0, wide * factor)));
  settings.set_height(static_cast<std::uint32_t>(std::max(1.0, high * factor)));
  settings.set_spp(8);
  settings.set_backend(v1::CPU);
  settings.clear_goal();
  settings.mutable_method()->mutable_exact();
  settings.set_verify(false);
  return scene;
}

/// The scene with the picture's camera: one that was moved by hand is the live view's alone.
SheetBase base_of(const Picture& picture, v1::Scene wanted,
                  std::shared_ptr<const client::CheckedScene> files) {
  *wanted.mutable_camera() = picture.scene->camera();
  return {.picture = picture, .wanted = std::move(wanted), .files = std::move(files)};
}

bool fits(const SheetBase& base) {
  return client::relit_scene(*base.picture.factors, *base.picture.scene, base.wanted,
                             [&](const std::string& name) { return base.files->read_asset(name); })
      .has_value();
}

}  // namespace

SheetBaseFinder::SheetBaseFinder(MainWindow& window) : QObject(&window), window_(window) {}

void SheetBaseFinder::find() {
  const auto sent = sendable(window_);
  if (!sent) return Q_EMIT failed(tr("There is no sound scene to make a sheet of, or no server."));
  const auto files = window_.document()->sound();
  QList<Picture> pictures;
  if (kept_) pictures << kept_->picture;
  for (int i = 0; i < window_.pictures().count(); ++i)
    if (const auto* page = qobject_cast<JobPage*>(window_.pictures().widget(i)))
      if (const auto& one = page->rendered(); one && one->factors && one->scene) pictures << *one;
  const auto work = [pictures, wanted = *sent->scene, files]() -> std::shared_ptr<const SheetBase> {
    for (auto one = pictures.rbegin(); one != pictures.rend(); ++one)
      if (SheetBase base = base_of(*one, wanted, files); fits(base))
        return std::make_shared<const SheetBase>(std::move(base));
    return nullptr;
  };
  on_pool(this, work, [this, number = ++asked_, scene = sent->scene](const auto& base) {
    if (number != asked_) return;
    if (base) return Q_EMIT found(base);
    render(*scene);
  });
}

void SheetBaseFinder::render(const v1::Scene& scene) {
  if (window_.document() == nullptr || !window_.document()->sound()) return;
  Q_EMIT rendering();
  auto sent = std::make_shared<const v1::Scene>(small(scene));
  client::Submission submission = client::make_submission(
      *sent, window_.document()->sound()->assets(), tr("metamerism sheet").toStdString(), false);
  submission.request.set_keep_factors(true);
  window_.link().submit(this, std::move(submission),
                        [this, number = asked_, sent](client::Answer<client::JobHandle> job) {
                          if (number != asked_) return;
                          if (!job)
                            return Q_EMIT failed(QString::fromStdString(job.error().message));
                          watch(*job, number, sent);
                        });
}

void SheetBaseFinder::watch(const client::JobHandle& job, unsigned number,
                            std::shared_ptr<const v1::Scene> scene) {
  const auto files = window_.document() == nullptr ? nullptr : window_.document()->sound();
  if (!files) return;
  const auto done = [this, number, scene, files](client::Answer<client::JobRecord> record) {
    if (number != asked_) return;
    if (!record) return Q_EMIT failed(QString::fromStdString(record.error().message));
    if (!record->film || !record->plan || !record->factors)
      return Q_EMIT failed(tr("The server rendered no picture with factors for the sheet."));
    const auto kept = std::make_shared<client::JobRecord>(std::move(*record));
    const auto work = [kept, scene, files] {
      Picture picture{.title = tr("metamerism sheet"),
                      .from = QString(),
                      .xyz = {kept, &kept->film->image()},
                      .plan = {kept, &*kept->plan},
                      .factors = std::make_shared<const client::Factors>(kept->factors->finish()),
                      .scene = scene};
      return std::make_shared<const SheetBase>(base_of(picture, *scene, files));
    };
    on_pool(this, work, [this, number](const std::shared_ptr<const SheetBase>& base) {
      kept_ = base;
      if (number == asked_) Q_EMIT found(base);
    });
  };
  window_.link().record(
      this, job, client::JobParts::picture_and_factors, [](const v1::JobEvent&) {}, done);
}

}  // namespace metamer::gui
