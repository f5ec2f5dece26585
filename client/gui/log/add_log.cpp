#include "client/gui/log/add_log.h"

#include <QPointer>
#include <QSet>

#include "client/gui/app/main_window.h"
#include "client/gui/log/log_dock.h"

namespace metamer::gui {
namespace {

void write_status(const client::LinkStatus& status, Log& log) {
  const QString name =
      status.server.empty() ? LogDock::tr("private server") : QString::fromStdString(status.server);
  switch (status.kind) {
    case client::LinkStatus::Kind::connecting:
      return log.write(LogKind::note, name, LogDock::tr("connecting"));
    case client::LinkStatus::Kind::ready: {
      QStringList backends;
      for (const std::string& one : status.welcome.capabilities().backend())
        backends << QString::fromStdString(one);
      return log.write(LogKind::note, name,
                       LogDock::tr("ready: %1 with %2")
                           .arg(QString::fromStdString(status.welcome.server()),
                                backends.join(QStringLiteral(", "))));
    }
    case client::LinkStatus::Kind::lost: {
      const QString why = QString::fromStdString(status.error.message);
      return log.write(
          LogKind::error, name,
          status.retry_in < 0
              ? why
              : LogDock::tr("%1; trying again in %2 s").arg(why).arg(status.retry_in, 0, 'g', 3));
    }
  }
}

/// What is to be known of the live view in front. Each notice of a scene is written once.
class LiveLog : public QObject {
 public:
  explicit LiveLog(MainWindow& window) : QObject(&window), window_(window) {
    connect(&window, &MainWindow::document_chosen, this, [this] { follow(); });
  }

 private:
  void follow() {
    if (live_ == window_.live()) return;
    if (live_ != nullptr) live_->disconnect(this);
    live_ = window_.live();
    if (live_ == nullptr) return;
    connect(live_, &LivePage::framed, this, [this] { take_notices(); });
    connect(live_, &LivePage::troubled, this, [this](const QString& why) {
      // Before the first check there is nothing to be shown, which is no trouble.
      if (live_->document().checked()) write(LogKind::warning, why);
    });
  }

  void take_notices() {
    for (const v1::Notice& notice : live_->frame()->plan.notice()) {
      const QString text = QString::fromStdString(
          notice.field().empty() ? notice.message() : notice.field() + ": " + notice.message());
      const QString scene = live_->document().path() + QLatin1Char('\n') + text;
      if (said_.contains(scene)) continue;
      said_.insert(scene);
      write(LogKind::warning, text);
    }
  }

  void write(LogKind kind, const QString& text) {
    window_.log().write(kind, LogDock::tr("Live: %1").arg(live_->document().title()), text);
  }

  MainWindow& window_;
  QPointer<LivePage> live_;
  QSet<QString> said_;
};

}  // namespace

void add_log(MainWindow& window) {
  auto* dock = new LogDock(window.log());
  window.add_dock(QStringLiteral("log"), LogDock::tr("Log"), dock, Qt::BottomDockWidgetArea)
      ->hide();
  // One that is ready says so once more where it is slow.
  auto tell = [&window, was_ready = false]() mutable {
    const bool ready = window.link().ready();
    if (!(ready && was_ready)) write_status(window.link().status(), window.log());
    was_ready = ready;
  };
  QObject::connect(&window.link(), &Link::status_changed, &window, tell);
  tell();
  new LiveLog(window);
}

}  // namespace metamer::gui
