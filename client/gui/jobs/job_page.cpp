#include "client/gui/jobs/job_page.h"

#include <QFutureWatcher>
#include <QVBoxLayout>
#include <QtConcurrentRun>
#include <utility>

#include "client/gui/jobs/job_words.h"
#include "client/session/submission.h"
#include "common/printable.h"

namespace metamer::gui {
namespace {

const QColor not_there_yet(119, 119, 119);  // as what surrounds pictures

}  // namespace

JobPage::JobPage(Link& link, QWidget* parent)
    : PicturePage(parent), link_(link), canvas_(new Canvas(this)), panel_(new JobPanel(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(canvas_, 1);
  layout->addWidget(panel_);
  setFocusProxy(canvas_);
  connect(canvas_, &Canvas::wheeled, canvas_, &Canvas::zoom);
  connect(canvas_, &Canvas::dragged, canvas_, &Canvas::shift);
  connect(panel_, &JobPanel::marked, this, &JobPage::titled);
  connect(panel_, &JobPanel::pause_asked, this, &JobPage::pause);
  connect(panel_, &JobPanel::cancel_asked, this, &JobPage::cancel);
  connect(panel_, &JobPanel::exact_asked, this, &JobPage::exact_asked);
  connect(&link_, &Link::status_changed, this, &JobPage::follow_link);
  connect(&link_, &Link::unknown_changed, this, [this] {
    const QString pause = link_.unknown(QStringLiteral("Pause"));
    panel_->forbid_pause(pause.isEmpty() ? link_.unknown(QStringLiteral("Resume")) : pause);
  });
}

QString JobPage::title() const { return QStringLiteral("%1 %2").arg(name_, panel_->mark()); }

void JobPage::render(std::shared_ptr<const v1::Scene> scene, std::vector<Asset> assets,
                     QString name) {
  name_ = std::move(name);
  scene_ = std::move(scene);
  assets_ = std::move(assets);
  panel_->show_state(tr("sending"));
  Q_EMIT titled();
  client::Submission submission =
      client::make_submission(*scene_, assets_, name_.toStdString(), false);
  const auto why_none = no_factors(*scene_, link_.status().welcome.capabilities());
  submission.request.set_keep_factors(!why_none);
  if (why_none) panel_->add_note(*why_none);
  link_.submit(this, std::move(submission), [this](client::Answer<client::JobHandle> job) {
    if (!job) return panel_->show_error(job.error());
    watch(*job, name_);
    Q_EMIT sent();
  });
}

void JobPage::watch(const client::JobHandle& job, const QString& name) {
  job_ = job;
  name_ = name;
  setToolTip(tr("Job %1").arg(QString::fromStdString(to_text(job))));
  delete watch_;
  watch_ = new JobWatch(link_, job, client::JobParts::picture_and_factors, this);
  connect(watch_, &JobWatch::event, this, [this](const auto& event) { take(*event); });
  connect(watch_, &JobWatch::grew, this, [this](const QList<ShownTile>& tiles) {
    for (const ShownTile& tile : tiles) canvas_->set_part(tile.corner, tile.image);
  });
  connect(watch_, &JobWatch::ended, this, &JobPage::keep);
  connect(watch_, &JobWatch::lost, this, [this](const auto& error) {
    panel_->show_error(*error);
    canvas_->set_stale(QString::fromStdString(printable(error->message)));
  });
  Q_EMIT titled();
}

/// A job goes on without its window, and its watch with the next session.
void JobPage::follow_link() {
  if (watch_ == nullptr || panel_->ended()) return;
  const QString why = link_.ready() ? QString() : tr("old: there is no server");
  panel_->set_interrupted(why);
  canvas_->set_stale(why);
}

void JobPage::take(const v1::JobEvent& event) {
  panel_->take(event);
  if (!event.has_planned()) return;
  const v1::Plan& plan = event.planned().plan();
  const QSize size(static_cast<int>(plan.width()), static_cast<int>(plan.height()));
  QImage image(grown_size(size), QImage::Format_RGB32);
  image.fill(not_there_yet);
  canvas_->set_image(image, color_space(developing_of(&plan)), size);
}

/// The record's parts become a picture; its factors are put together on the pool.
void JobPage::keep(const std::shared_ptr<client::JobRecord>& record) {
  if (record->factors_lost)
    panel_->add_note(tr("The server keeps no more factors: other light is traced anew."));
  if (!record->last.has_finished() || !record->film || !record->plan) {
    canvas_->set_stale(state_text(record->last));
    return;
  }
  finished_ = record->last.finished();
  if (!record->factors) return complete(record, nullptr);
  using Made = std::shared_ptr<const client::Factors>;
  auto* watcher = new QFutureWatcher<Made>(this);
  connect(watcher, &QFutureWatcherBase::finished, this, [this, watcher, record] {
    watcher->deleteLater();
    complete(record, watcher->result());
  });
  watcher->setFuture(QtConcurrent::run([record]() -> Made {
    Made made = std::make_shared<const client::Factors>(record->factors->finish());
    record->factors.reset();
    return made;
  }));
}

void JobPage::complete(const std::shared_ptr<client::JobRecord>& record,
                       std::shared_ptr<const client::Factors> factors) {
  picture_ = Picture{.title = name_,
                     .from = tr("job %1").arg(QString::fromStdString(to_text(record->job))),
                     .xyz = {record, &record->film->image()},
                     .plan = {record, &*record->plan},
                     .factors = std::move(factors),
                     .scene = scene_};
  canvas_->set_picture(shown_xyz(*picture_));
  Q_EMIT completed();
}

void JobPage::show_relit(const std::optional<Picture>& relit, const QString& note) {
  relit_ = relit;
  canvas_->set_picture(shown_xyz(*picture()));
  canvas_->set_overlay(note.isEmpty() ? QStringList() : QStringList(note));
}

void JobPage::order(Link::Order order) {
  link_.control(this, order, job_, [this](client::Answer<v1::JobSummary> done) {
    if (!done) panel_->add_note(QString::fromStdString(printable(done.error().message)));
  });
}

void JobPage::pause() {
  if (job_.number == 0 || panel_->ended()) return;
  order(panel_->paused() ? Link::Order::resume : Link::Order::pause);
}

void JobPage::cancel() {
  if (job_.number == 0 || panel_->ended()) return;
  order(Link::Order::cancel);
}

}  // namespace metamer::gui
