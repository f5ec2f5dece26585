#include "client/gui/document/document.h"

#include <QFutureWatcher>
#include <QtConcurrentRun>
#include <utility>

namespace metamer::gui {

Document::Document(QObject* parent)
    : TextFile(parent), digests_(std::make_shared<client::DigestCache>()) {
  timer_.setSingleShot(true);
  timer_.setInterval(quiet);
  connect(&timer_, &QTimer::timeout, this, &Document::start_check);
  connect(this, &TextFile::typed, &timer_, qOverload<>(&QTimer::start));
  connect(this, &TextFile::loaded, this, &Document::check_now);
  connect(this, &TextFile::saved, this, &Document::check_now);
}

Document::~Document() = default;

void Document::check_now() {
  timer_.stop();
  start_check();
}

/// One check at a time: what is typed meanwhile is checked after it.
void Document::start_check() {
  if (std::exchange(checking_, true)) {
    again_ = true;
    return;
  }
  again_ = false;
  const auto check = [text = text().toStdString(), path = path().toStdString(),
                      digests = digests_] {
    return std::make_shared<const client::CheckedScene>(
        client::CheckedScene::parse(text, path.empty() ? "untitled.txtpb" : path, *digests));
  };
  auto* watcher = new QFutureWatcher<std::shared_ptr<const client::CheckedScene>>(this);
  connect(watcher, &QFutureWatcherBase::finished, this, [this, watcher] {
    checked_ = watcher->result();
    watcher->deleteLater();
    if (checked_->sound()) sound_ = checked_;
    checking_ = false;
    set_problems(checked_->problems());
    Q_EMIT checked_changed();
    if (again_) start_check();
  });
  watcher->setFuture(QtConcurrent::run(check));
}

void Document::set_problems(std::vector<Problem> problems) {
  if (problems.empty() && problems_.empty()) return;
  problems_ = std::move(problems);
  Q_EMIT problems_changed();
}

void Document::set_server_problems(const std::vector<Problem>& problems) {
  if (checked_ && checked_->sound()) set_problems(checked_->locate(problems));
}

void Document::set_look(client::Look look) {
  look_ = std::move(look);
  Q_EMIT look_changed();
}

void Document::set_camera(const std::optional<v1::Camera>& camera) {
  camera_ = camera;
  Q_EMIT camera_changed();
}

v1::Camera Document::seen_camera() const {
  if (camera_) return *camera_;
  if (look_.camera) return *look_.camera;
  return sound_ ? sound_->scene().camera() : v1::Camera();
}

Result<v1::Scene> Document::effective() const {
  if (!sound_) return problem("the scene has problems");
  v1::Scene scene = sound_->scene();
  if (auto done = client::apply(look_, scene); !done) return tl::unexpected(done.error());
  if (camera_) *scene.mutable_camera() = *camera_;
  return scene;
}

}  // namespace metamer::gui
