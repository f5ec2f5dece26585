#include "client/gui/jobs/job_panel.h"

#include <QHBoxLayout>
#include <QVBoxLayout>
#include <utility>

#include "client/gui/jobs/job_words.h"
#include "client/tools/text/job_text.h"
#include "common/printable.h"

namespace metamer::gui {
namespace {

/// Of what went wrong; a sign says it too.
const QColor wrong_on_light(0xb0, 0x00, 0x20), wrong_on_dark(0xff, 0x8a, 0x80);

QString panel_text(const std::string& text) { return QString::fromStdString(printable(text)); }

}  // namespace

JobPanel::JobPanel(QWidget* parent)
    : QWidget(parent),
      state_(new QLabel),
      speed_(new QLabel),
      bar_(new QProgressBar),
      pause_(new QPushButton(tr("Pause"))),
      cancel_(new QPushButton(tr("Cancel"))),
      exact_(new QPushButton(tr("Render by exact"))),
      rows_(new QFormLayout) {
  bar_->setRange(0, 1);
  bar_->setAccessibleName(tr("Progress"));
  pause_->setToolTip(tr("Space"));
  cancel_->setToolTip(tr("Esc"));
  exact_->hide();
  state_->setTextFormat(Qt::PlainText);
  auto* line = new QHBoxLayout;
  line->addWidget(state_);
  line->addWidget(bar_, 1);
  line->addWidget(speed_);
  line->addWidget(exact_);
  line->addWidget(pause_);
  line->addWidget(cancel_);
  auto* layout = new QVBoxLayout(this);
  layout->addLayout(line);
  layout->addLayout(rows_);
  promise_ = add_row(tr("Promise"));
  configuration_ = add_row(tr("Configuration"));
  notes_ = add_row(tr("Notes"));
  times_ = add_row(tr("Times"));
  connect(pause_, &QPushButton::clicked, this, &JobPanel::pause_asked);
  connect(cancel_, &QPushButton::clicked, this, &JobPanel::cancel_asked);
  connect(exact_, &QPushButton::clicked, this, &JobPanel::exact_asked);
  set_mark(QStringLiteral("…"));
}

QLabel* JobPanel::add_row(const QString& name) {
  auto* label = new QLabel;
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  rows_->addRow(name, label);
  rows_->setRowVisible(label, false);
  return label;
}

void JobPanel::show_state(const QString& text) {
  state_->setText(text);
  Q_EMIT said(LogKind::note, text);
}

void JobPanel::forbid_pause(const QString& why) {
  pause_->setEnabled(why.isEmpty());
  pause_->setToolTip(why.isEmpty() ? tr("Space") : why);
}

void JobPanel::set_interrupted(const QString& why) {
  if (before_.isEmpty()) before_ = state_->text();
  state_->setText(why.isEmpty() ? std::exchange(before_, {}) : why);
}

void JobPanel::take(const v1::JobEvent& event) {
  if (const QString text = state_text(event); !text.isEmpty()) {
    state_->setText(text);
    Q_EMIT said(event.has_failed() ? LogKind::error : LogKind::note, text);
  }
  switch (event.event_case()) {
    case v1::JobEvent::kPlanned:
      return take_planned(event.planned().plan());
    case v1::JobEvent::kProgress:
      return take_progress(event.progress());
    case v1::JobEvent::kStarted:
      set_paused(false);
      return bar_->setRange(0, 0);
    case v1::JobEvent::kQueued:
      return set_paused(false);
    case v1::JobEvent::kPaused:
      return set_paused(true);
    case v1::JobEvent::kFinished:
      return take_finished(event.finished());
    case v1::JobEvent::kFailed:
      for (const v1::Problem& problem : event.failed().problem())
        add_note(problem_line(problem), LogKind::error);
      return end(QStringLiteral("✗"));
    case v1::JobEvent::kCancelled:
      return end(QStringLiteral("✗"));
    case v1::JobEvent::kRetrying:
    case v1::JobEvent::kPreparing:
    case v1::JobEvent::kPrepared:
    case v1::JobEvent::kTile:
    case v1::JobEvent::kPreview:
    case v1::JobEvent::EVENT_NOT_SET:
      return;
  }
}

void JobPanel::take_planned(const v1::Plan& plan) {
  plan_ = plan;
  configuration_->setText(QString::fromStdString(client::describe(plan)));
  rows_->setRowVisible(configuration_, true);
  plan_notes_.clear();
  for (const v1::Notice& notice : plan.notice())
    plan_notes_ << panel_text(notice.field().empty() ? notice.message()
                                                     : notice.field() + ": " + notice.message());
  show_notes();
  for (const QString& notice : plan_notes_) Q_EMIT said(LogKind::warning, notice);
}

void JobPanel::take_progress(const v1::Progress& progress) {
  const int tiles = static_cast<int>(progress.tiles());
  const bool verifying = progress.tiles_verified() > 0;
  const int done = static_cast<int>(verifying ? progress.tiles_verified() : progress.tiles_done());
  bar_->setRange(0, std::max(1, tiles));
  bar_->setValue(done);
  if (!paused_) state_->setText(verifying ? tr("verifying") : tr("rendering"));
  speed_->setText(
      tr("%1 · %2 left")
          .arg(QString::fromStdString(client::rate(progress.rays(), progress.seconds())),
               QString::fromStdString(client::clock(progress.seconds_left()))));
  set_mark(tr("%1 %").arg(tiles > 0 ? 100 * done / tiles : 0));
}

void JobPanel::take_finished(const v1::Finished& finished) {
  QStringList times;
  for (const auto& [name, seconds] : timing_rows(finished.timing()))
    times << QStringLiteral("%1 %2").arg(name.trimmed(), seconds_text(seconds));
  times_->setText(times.join(QStringLiteral(" · ")));
  rows_->setRowVisible(times_, !check_);
  if (check_) state_->setText(tr("ready"));
  bool kept = true;
  if (const auto promise = plan_ ? promise_of(*plan_, finished) : std::nullopt) {
    kept = promise->kept;
    promise_->setText(promise->text);
    Q_EMIT said(kept ? LogKind::note : LogKind::warning, promise->text);
    promise_->setToolTip(promise->detail);
    rows_->setRowVisible(promise_, true);
    if (!kept) {
      QPalette colors = promise_->palette();
      const bool dark = colors.color(QPalette::Window).lightness() < 128;
      colors.setColor(QPalette::WindowText, dark ? wrong_on_dark : wrong_on_light);
      promise_->setPalette(colors);
      exact_->show();
    }
  }
  end(kept ? QStringLiteral("✓") : QStringLiteral("✗"));
  bar_->setRange(0, 1);
  bar_->setValue(1);
}

void JobPanel::add_note(const QString& note, LogKind kind) {
  own_notes_ << note;
  Q_EMIT said(kind, note);
  show_notes();
}

void JobPanel::show_notes() {
  const QStringList all = own_notes_ + plan_notes_;
  notes_->setText(all.join(QLatin1Char('\n')));
  rows_->setRowVisible(notes_, !all.isEmpty());
}

void JobPanel::show_error(const client::SessionError& error) {
  state_->setText(tr("lost: %1").arg(panel_text(error.message)));
  Q_EMIT said(LogKind::error, state_->text());
  for (const v1::Problem& problem : error.problems) add_note(problem_line(problem), LogKind::error);
  end(QStringLiteral("✗"));
}

void JobPanel::end(const QString& mark) {
  ended_ = true;
  pause_->hide();
  cancel_->hide();
  speed_->clear();
  if (bar_->maximum() == 0) bar_->setRange(0, 1);
  set_mark(mark);
}

void JobPanel::set_paused(bool paused) {
  paused_ = paused;
  pause_->setText(paused ? tr("Go on") : tr("Pause"));
}

void JobPanel::set_mark(const QString& mark) {
  mark_ = mark;
  Q_EMIT marked();
}

}  // namespace metamer::gui
