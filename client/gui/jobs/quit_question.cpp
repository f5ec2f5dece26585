#include "client/gui/jobs/quit_question.h"

#include <QEvent>
#include <QPushButton>

#include "client/gui/jobs/job_table.h"
#include "common/printable.h"

namespace metamer::gui {
namespace {

constexpr std::chrono::seconds between_looks{1};
constexpr int most_named = 5;

/// A line for each job that has not ended; empty: all have.
QString unended_jobs(const v1::JobList& list) {
  QStringList lines;
  for (const v1::JobSummary& job : list.job()) {
    if (has_ended(job.state())) continue;
    QString line = QuitQuestion::tr("job %1, %2")
                       .arg(job.job_id())
                       .arg(QString::fromStdString(printable(job.name())));
    if (job.state() == v1::PAUSED) line += QuitQuestion::tr(": paused");
    if (job.state() != v1::PAUSED && job.tiles() > 0)
      line += QuitQuestion::tr(": %1 %").arg(100 * job.tiles_done() / job.tiles());
    lines << line;
  }
  const auto others = lines.size() - most_named;
  if (others > 0) lines = lines.mid(0, most_named) << QuitQuestion::tr("and %1 more").arg(others);
  return lines.join(QLatin1Char('\n'));
}

}  // namespace

QuitQuestion::QuitQuestion(MainWindow& window) : QObject(&window), window_(window) {
  window.installEventFilter(this);
  timer_.setSingleShot(true);
  connect(&timer_, &QTimer::timeout, this, [this] { listed_ ? look() : close(); });
}

bool QuitQuestion::eventFilter(QObject*, QEvent* event) {
  const bool own = window_.link().ready() && window_.link().status().server.empty();
  if (event->type() != QEvent::Close || !own || state_ == State::closing) return false;
  event->ignore();
  if (state_ == State::open) {
    state_ = State::asking;
    look();
  }
  return true;
}

void QuitQuestion::look() {
  listed_ = false;
  timer_.start(patience);
  window_.link().list(this, [this](const client::Answer<client::ServerJobs>& jobs) { take(jobs); });
}

void QuitQuestion::take(const client::Answer<client::ServerJobs>& listed) {
  listed_ = true;
  timer_.stop();
  if (state_ == State::open || state_ == State::closing) return;
  const QString jobs = listed ? unended_jobs(listed->list) : QString();
  if (jobs.isEmpty()) return close();
  ask(jobs);
  timer_.start(between_looks);
}

void QuitQuestion::ask(const QString& jobs) {
  if (box_) return box_->setInformativeText(jobs);
  const bool waiting = state_ == State::waiting;
  box_ =
      new QMessageBox(QMessageBox::Question, tr("Quit"),
                      waiting ? tr("The window closes when these have ended:")
                              : tr("These have not ended, and their server ends with the window:"),
                      QMessageBox::NoButton, &window_);
  box_->setAttribute(Qt::WA_DeleteOnClose);
  box_->setTextFormat(Qt::PlainText);
  box_->setInformativeText(jobs);
  if (!waiting) box_->addButton(tr("&Wait for them"), QMessageBox::AcceptRole);
  box_->addButton(tr("&Cancel them"), QMessageBox::DestructiveRole);
  box_->setDefaultButton(box_->addButton(tr("&Stay"), QMessageBox::RejectRole));
  connect(box_, &QMessageBox::finished, this, [this, box = box_.data()] { answer(box); });
  box_->open();
}

void QuitQuestion::answer(QMessageBox* box) {
  const auto role = box->buttonRole(box->clickedButton());
  box_.clear();
  if (role == QMessageBox::DestructiveRole) return close();
  state_ = role == QMessageBox::AcceptRole ? State::waiting : State::open;
  if (state_ == State::open) timer_.stop();
}

void QuitQuestion::close() {
  timer_.stop();
  if (box_) box_->deleteLater();
  box_.clear();
  state_ = State::closing;
  window_.close();
  state_ = State::open;
}

}  // namespace metamer::gui
