#include "client/gui/looks/relighter.h"

#include <utility>

#include "client/gui/app/on_pool.h"
#include "client/relight/relight.h"
#include "client/tools/pictures/relit_scene.h"

namespace metamer::gui {
namespace {

/// A picture under another look, or why it is not.
struct RelitPicture {
  std::optional<Picture> picture = {};
  QString note = {};
};

/// In the thread pool.
RelitPicture relit_picture(const Picture& rendered, v1::Scene wanted,
                           const client::CheckedScene& files) {
  if (wanted.has_camera()) *wanted.mutable_camera() = rendered.scene->camera();
  if (client::same_look(*rendered.scene, wanted)) return {};
  auto relit = client::relit_scene(*rendered.factors, *rendered.scene, wanted,
                                   [&](const std::string& name) { return files.read_asset(name); });
  if (!relit)
    return {.note = Relighter::tr("as it was rendered: %1")
                        .arg(QString::fromStdString(relit.error().message))};
  Picture picture = rendered;
  picture.title = Relighter::tr("%1, relit").arg(rendered.title);
  picture.xyz = std::make_shared<const Image>(client::relight(
      *rendered.factors, relit->scene, client::observer_of(relit->plan, relit->scene)));
  picture.plan = std::make_shared<const v1::Plan>(std::move(relit->plan));
  picture.relit = std::make_shared<const v1::SceneFactors>(std::move(relit->scene));
  picture.scene = std::make_shared<const v1::Scene>(std::move(wanted));
  return {.picture = std::move(picture), .note = Relighter::tr("relit · exact")};
}

}  // namespace

Relighter::Relighter(MainWindow& window) : QObject(&window), window_(window) {
  connect(&window.pictures(), &QTabWidget::currentChanged, this, &Relighter::follow);
  connect(&window, &MainWindow::document_chosen, this, &Relighter::follow_document);
}

void Relighter::follow_document() {
  if (document_ == window_.document()) return;
  if (document_ != nullptr) document_->disconnect(this);
  document_ = window_.document();
  if (document_ == nullptr) return;
  connect(document_, &Document::look_changed, this, &Relighter::relight);
  connect(document_, &Document::checked_changed, this, &Relighter::relight);
  relight();
}

void Relighter::follow() {
  if (page_ != nullptr) page_->disconnect(this);
  page_ = qobject_cast<JobPage*>(window_.picture_page());
  if (page_ == nullptr) return;
  connect(page_, &JobPage::completed, this, &Relighter::relight);
  relight();
}

void Relighter::relight() {
  if (page_ == nullptr || document_ == nullptr || !document_->sound()) return;
  const std::optional<Picture>& rendered = page_->rendered();
  if (!rendered || !rendered->factors || !rendered->scene) return;
  const Result<v1::Scene> wanted = document_->effective();
  if (!wanted) return;
  const auto work = [picture = *rendered, wanted = *wanted, files = document_->sound()] {
    return relit_picture(picture, wanted, *files);
  };
  on_pool(this, work, [this, number = ++asked_, page = page_](const RelitPicture& relit) {
    if (number == asked_ && page != nullptr) page->show_relit(relit.picture, relit.note);
  });
}

}  // namespace metamer::gui
