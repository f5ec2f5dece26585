#include "client/gui/methods/tradeoff_job.h"

#include <utility>

#include "client/gui/app/on_pool.h"
#include "common/printable.h"

namespace metamer::gui {

QString stop_text(const client::TradeoffStop& stop) {
  switch (stop.kind) {
    case client::TradeoffStop::Kind::session:
      return QString::fromStdString(printable(stop.error.message));
    case client::TradeoffStop::Kind::cancelled:
      return QObject::tr("cancelled");
    case client::TradeoffStop::Kind::reference:
      return QObject::tr("the reference can't be rendered: %1")
          .arg(QString::fromStdString(printable(stop.problem.message)));
    case client::TradeoffStop::Kind::picture:
      break;
  }
  return QString::fromStdString(printable(format(stop.problem)));
}

TradeoffJob::TradeoffJob(Link& link, std::shared_ptr<const v1::Scene> scene,
                         std::vector<Asset> assets, const QString& name, unsigned rounds,
                         QObject* parent)
    : QObject(parent),
      link_(link),
      shared_(std::make_shared<Shared>(std::move(scene), std::move(assets), name, rounds)) {
  // Who makes it connects to it first.
  QMetaObject::invokeMethod(this, &TradeoffJob::begin_next, Qt::QueuedConnection);
}

TradeoffJob::~TradeoffJob() { order_cancel(); }

void TradeoffJob::order_cancel() {
  if (job_.number != 0) link_.hub().control(Link::Order::cancel, job_, [](const auto&) {});
}

void TradeoffJob::cancel() {
  cancelled_ = true;
  order_cancel();
}

void TradeoffJob::begin_next() {
  if (cancelled_) return take(tl::unexpected(client::TradeoffStop()));
  client::TradeoffSteps& steps = shared_->steps;
  std::optional<client::Submission> submission = steps.next();
  if (!submission) return Q_EMIT finished(std::make_shared<const client::Tradeoff>(steps.so_far()));
  Q_EMIT begun(steps.jobs_done() + 1, steps.jobs(), QString::fromStdString(steps.due()));
  link_.submit(this, std::move(*submission), [this](client::Answer<client::JobHandle> job) {
    if (job) return watch(*job);
    if (job.error().kind == client::SessionError::Kind::refused)
      return take(shared_->steps.refused(job.error().message));
    take(tl::unexpected<client::TradeoffStop>(
        {.kind = client::TradeoffStop::Kind::session, .error = std::move(job.error())}));
  });
}

void TradeoffJob::watch(const client::JobHandle& job) {
  job_ = job;
  if (cancelled_) order_cancel();  // it was asked for while the job was on its way
  link_.record(
      this, job, client::JobParts::picture, [](const v1::JobEvent&) {},
      [this](client::Answer<client::JobRecord> job) {
        job_ = {};
        if (!job)
          return take(tl::unexpected<client::TradeoffStop>(
              {.kind = client::TradeoffStop::Kind::session, .error = std::move(job.error())}));
        auto record = std::make_shared<client::JobRecord>(std::move(*job));
        on_pool(
            this, [shared = shared_, record]() -> Done { return shared->steps.ended(*record); },
            [this](const Done& done) { take(done); });
      });
}

void TradeoffJob::take(const Done& done) {
  if (done) return begin_next();
  Q_EMIT stopped(stop_text(done.error()));
}

}  // namespace metamer::gui
