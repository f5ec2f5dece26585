#include "client/gui/link/link.h"

#include <utility>

namespace metamer::gui {
namespace {

const char* message_of(Link::Order order) {
  switch (order) {
    case Link::Order::cancel:
      return "Cancel";
    case Link::Order::pause:
      return "Pause";
    case Link::Order::resume:
      return "Resume";
  }
  return "";
}

}  // namespace

Link::Link(QObject* parent) : QObject(parent) {
  hub_ = std::make_unique<client::SessionHub>([this](const client::LinkStatus& status) {
    deliver(this, [this, status] {
      status_ = status;
      // The next server may be another one.
      if (!ready() && !unknown_.isEmpty()) {
        unknown_.clear();
        Q_EMIT unknown_changed();
      }
      Q_EMIT status_changed();
    });
  });
}

void Link::deliver(QPointer<QObject> context, std::function<void()> work) {
  QMetaObject::invokeMethod(
      this,
      [context = std::move(context), work = std::move(work)] {
        if (context) work();
      },
      Qt::QueuedConnection);
}

template <class T>
Link::Done<T> Link::here(QObject* context, const char* message, Done<T> done) {
  return [this, context = QPointer<QObject>(context), message,
          done = std::move(done)](client::Answer<T> answer) {
    auto held = std::make_shared<client::Answer<T>>(std::move(answer));
    deliver(context, [this, message, done, held] {
      if (!*held && held->error().code == v1::Error::UNKNOWN_MESSAGE)
        note_unknown(QString::fromUtf8(message));
      done(std::move(*held));
    });
  };
}

QString Link::server_name() const {
  return status_.server.empty() ? tr("a private server") : QString::fromStdString(status_.server);
}

QString Link::unknown(const QString& message) const {
  return unknown_.contains(message) ? tr("this server does not know %1").arg(message) : QString();
}

void Link::note_unknown(const QString& message) {
  if (unknown_.contains(message)) return;
  unknown_.insert(message);
  Q_EMIT unknown_changed();
}

void Link::open(const QString& server) {
  status_ = {.kind = client::LinkStatus::Kind::connecting, .server = server.toStdString()};
  Q_EMIT status_changed();
  hub_->open(server.toStdString());
}

void Link::retry_now() { hub_->retry_now(); }
void Link::stop() { hub_->stop(); }

void Link::info(QObject* context, Done<v1::Info> done) {
  hub_->info(here(context, "GetInfo", std::move(done)));
}

void Link::list(QObject* context, Done<client::ServerJobs> done) {
  hub_->list(here(context, "ListJobs", std::move(done)));
}

void Link::control(QObject* context, Order order, client::JobHandle job,
                   Done<v1::JobSummary> done) {
  hub_->control(order, std::move(job), here(context, message_of(order), std::move(done)));
}

void Link::submit(QObject* context, client::Submission submission, Done<client::JobHandle> done) {
  hub_->submit(std::move(submission), here(context, "Submit", std::move(done)));
}

void Link::record(QObject* context, client::JobHandle job, client::JobParts parts,
                  std::function<void(const v1::JobEvent&)> on_event, Done<client::JobRecord> done) {
  std::stop_source stop;
  connect(context, &QObject::destroyed, this, [stop]() mutable { stop.request_stop(); });
  hub_->record(
      std::move(job), parts, stop.get_token(),
      [this, context = QPointer<QObject>(context), on_event = std::move(on_event)](
          const v1::JobEvent& event) { deliver(context, [on_event, event] { on_event(event); }); },
      here(context, "Watch", std::move(done)));
}

}  // namespace metamer::gui
