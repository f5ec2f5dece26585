#include "client/gui/app/link_bar.h"

#include <QHBoxLayout>
#include <QVBoxLayout>
#include <cmath>

#include "common/printable.h"

namespace metamer::gui {
namespace {

using Kind = client::LinkStatus::Kind;

const QColor amber(0xff, 0xc1, 0x4d);  // under black text, in light and dark themes
constexpr double patience = 1;         // seconds until a connection is told that is being made

}  // namespace

LinkBar::LinkBar(Link& link, QWidget* parent)
    : QWidget(parent),
      link_(link),
      text_(new QLabel),
      now_(new QPushButton(tr("Now"))),
      stop_(new QPushButton(tr("Cancel"))),
      own_(new QPushButton(tr("Private server"))),
      other_(new QPushButton(tr("Other…"))) {
  setObjectName(QStringLiteral("link_bar"));
  setAutoFillBackground(true);
  QPalette colors = palette();
  colors.setColor(QPalette::Window, amber);
  colors.setColor(QPalette::WindowText, Qt::black);
  setPalette(colors);
  text_->setTextFormat(Qt::PlainText);
  text_->setWordWrap(true);
  text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* line = new QHBoxLayout(this);
  line->setContentsMargins(8, 2, 8, 2);
  line->addWidget(text_, 1);
  for (QPushButton* button : {now_, stop_, own_, other_}) line->addWidget(button);
  connect(now_, &QPushButton::clicked, &link_, &Link::retry_now);
  connect(stop_, &QPushButton::clicked, &link_, &Link::stop);
  connect(own_, &QPushButton::clicked, &link_, [this] { link_.open({}); });
  connect(other_, &QPushButton::clicked, this, &LinkBar::other_asked);
  connect(&link_, &Link::status_changed, this, &LinkBar::follow);
  connect(&beat_, &QTimer::timeout, this, &LinkBar::show_text);
  beat_.setInterval(250);
  follow();
}

void LinkBar::follow() {
  const client::LinkStatus& status = link_.status();
  since_.start();
  const bool lost = status.kind == Kind::lost, again = status.retry_in >= 0;
  // Who speaks another version will do so again.
  now_->setVisible(lost && status.error.kind != client::SessionError::Kind::version);
  now_->setText(again ? tr("Now") : tr("Try again"));
  stop_->setVisible(status.kind == Kind::connecting);
  own_->setVisible(lost && !status.server.empty());
  other_->setVisible(lost);
  if (status.kind == Kind::connecting || (lost && again) || status.slow > 0)
    beat_.start();
  else
    beat_.stop();
  show_text();
}

void LinkBar::show_text() {
  const client::LinkStatus& status = link_.status();
  const double seconds = static_cast<double>(since_.elapsed()) / 1000;
  QString text;
  switch (status.kind) {
    case Kind::connecting:
      if (seconds >= patience)
        text = tr("connecting to %1 … %2 s").arg(link_.server_name()).arg(seconds, 0, 'f', 0);
      break;
    case Kind::ready:
      if (status.slow > 0)
        text = tr("%1 is slow: an answer takes %2 s")
                   .arg(link_.server_name())
                   .arg(status.slow, 0, 'f', 1);
      break;
    case Kind::lost:
      text = QString::fromStdString(printable(status.error.message));
      // One that is started anew at once is not worth a word.
      if (status.retry_in == 0 && seconds < patience) text.clear();
      if (status.retry_in > 0)
        text +=
            tr("; trying again in %1 s").arg(std::max(0.0, std::ceil(status.retry_in - seconds)));
      break;
  }
  text_->setText(text);
  setVisible(!text.isEmpty());
}

void add_link_bar(MainWindow& window) {
  auto* bar = new LinkBar(window.link(), &window);
  QObject::connect(bar, &LinkBar::other_asked, window.actions()[QStringLiteral("help.server")],
                   &QAction::trigger);
  auto* middle = new QWidget;
  auto* layout = new QVBoxLayout(middle);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(0);
  layout->addWidget(bar);
  layout->addWidget(window.takeCentralWidget(), 1);
  window.setCentralWidget(middle);
}

}  // namespace metamer::gui
