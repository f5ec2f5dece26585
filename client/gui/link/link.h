#pragma once

#include <QObject>
#include <QPointer>
#include <QSet>
#include <functional>
#include <memory>

#include "client/session/hub.h"

namespace metamer::gui {

/// The session with a server, for the window's thread: what it says comes as signals and calls
/// there. Nothing here waits.
class Link : public QObject {
  Q_OBJECT
 public:
  template <class T>
  using Done = std::function<void(client::Answer<T>)>;
  using Order = client::SessionHub::Order;

  explicit Link(QObject* parent = nullptr);

  /// "unix:PATH", "HOST:PORT", or "" for a private one.
  void open(const QString& server);
  void retry_now();
  void stop();
  const client::LinkStatus& status() const { return status_; }
  bool ready() const { return status_.kind == client::LinkStatus::Kind::ready; }
  /// "a private server", "render-box:7878".
  QString server_name() const;

  /// A server that is older than this program may not know a message; which, shows when it is sent.
  /// Why it can't be used: "this server does not know Probe"; empty: nothing is known against it.
  QString unknown(const QString& message) const;
  void note_unknown(const QString& message);

  /// Requests: `done` is called in this thread, unless `context` has gone.
  void info(QObject* context, Done<v1::Info> done);
  void list(QObject* context, Done<client::ServerJobs> done);
  void control(QObject* context, Order order, client::JobHandle job, Done<v1::JobSummary> done);
  void submit(QObject* context, client::Submission submission, Done<client::JobHandle> done);
  /// Each event of a job, then its record. Ends when `context` goes.
  void record(QObject* context, client::JobHandle job, client::JobParts parts,
              std::function<void(const v1::JobEvent&)> on_event, Done<client::JobRecord> done);

  client::SessionHub& hub() { return *hub_; }
  /// Runs `work` in this object's thread, unless `context` has gone by then. From any thread.
  void deliver(QPointer<QObject> context, std::function<void()> work);

 Q_SIGNALS:
  void status_changed();
  void unknown_changed();

 private:
  template <class T>
  Done<T> here(QObject* context, const char* message, Done<T> done);

  client::LinkStatus status_;
  QSet<QString> unknown_;  ///< Messages that this server has refused as such.
  std::unique_ptr<client::SessionHub> hub_;
};

}  // namespace metamer::gui
