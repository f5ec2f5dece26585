#include "client/gui/app/server_dialog.h"

#include <QDialogButtonBox>
#include <QFormLayout>
#include <QPushButton>
#include <QSettings>

namespace metamer::gui {
namespace {

QString info_text(const v1::Info& info) {
  QStringList lines;
  lines << QObject::tr("%1, up %2 min, sessions: %3")
               .arg(QString::fromStdString(info.server()))
               .arg(info.uptime() / 60, 0, 'f', 0)
               .arg(info.sessions());
  lines
      << QObject::tr("%1 jobs running, %2 queued").arg(info.jobs_running()).arg(info.jobs_queued());
  for (const v1::WorkerInfo& worker : info.worker())
    lines << QObject::tr("%1 worker: %2")
                 .arg(QString::fromStdString(worker.backend()),
                      QString::fromStdString(worker.state()));
  if (info.capabilities().has_gl()) {
    const v1::GlCapabilities& gl = info.capabilities().gl();
    lines << QObject::tr("GL: %1%2")
                 .arg(QString::fromStdString(gl.renderer()),
                      gl.software() ? QObject::tr(" (software)") : QString());
  }
  return lines.join(QLatin1Char('\n'));
}

}  // namespace

ServerDialog::ServerDialog(Link& link, QWidget* parent)
    : QDialog(parent),
      link_(link),
      status_(new QLabel),
      info_(new QLabel),
      address_(new QLineEdit) {
  setWindowTitle(tr("Server"));
  auto* form = new QFormLayout(this);
  status_->setWordWrap(true);
  info_->setWordWrap(true);
  form->addRow(tr("Status"), status_);
  form->addRow(tr("It says"), info_);
  form->addRow(tr("Another"), address_);
  address_->setPlaceholderText(QStringLiteral("unix:/run/metamer/socket, render-box:7878"));
  auto* buttons = new QDialogButtonBox;
  QPushButton* connect_button = buttons->addButton(tr("Connect"), QDialogButtonBox::ActionRole);
  QPushButton* own = buttons->addButton(tr("Private server"), QDialogButtonBox::ActionRole);
  QPushButton* retry = buttons->addButton(tr("Try again"), QDialogButtonBox::ActionRole);
  buttons->addButton(QDialogButtonBox::Close);
  form->addRow(buttons);
  connect(connect_button, &QPushButton::clicked, this, [this] {
    if (address_->text().isEmpty()) return;
    QSettings().setValue(QStringLiteral("server"), address_->text());
    link_.open(address_->text());
  });
  connect(own, &QPushButton::clicked, this, [this] { link_.open({}); });
  connect(retry, &QPushButton::clicked, this, [this] { link_.retry_now(); });
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
  connect(&link_, &Link::status_changed, this, &ServerDialog::show_status);
  address_->setText(QSettings().value(QStringLiteral("server")).toString());
  resize(480, sizeHint().height());
  show_status();
}

void ServerDialog::show_status() {
  const client::LinkStatus& status = link_.status();
  const QString name =
      status.server.empty() ? tr("a private server") : QString::fromStdString(status.server);
  info_->clear();
  switch (status.kind) {
    case client::LinkStatus::Kind::connecting:
      return status_->setText(tr("connecting to %1").arg(name));
    case client::LinkStatus::Kind::lost:
      return status_->setText(tr("%1: %2%3")
                                  .arg(name, QString::fromStdString(status.error.message),
                                       status.retry_in >= 0
                                           ? tr("; tried again in %1 s").arg(status.retry_in)
                                           : QString()));
    case client::LinkStatus::Kind::ready:
      status_->setText(tr("connected to %1").arg(name));
      return link_.info(this, [this](client::Answer<v1::Info> info) {
        info_->setText(info ? info_text(*info) : QString::fromStdString(info.error().message));
      });
  }
}

}  // namespace metamer::gui
