#include "client/gui/jobs/jobs_dock.h"

#include <QCheckBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLineEdit>
#include <QMessageBox>
#include <QVBoxLayout>

#include "client/gui/spectra/compact_table.h"
#include "common/printable.h"

namespace metamer::gui {
namespace {

QTableView* make_job_view(QAbstractItemModel& model) {
  auto* view = new QTableView;
  view->setModel(&model);
  view->setSelectionBehavior(QAbstractItemView::SelectRows);
  view->setSelectionMode(QAbstractItemView::SingleSelection);
  view->setSortingEnabled(true);
  view->sortByColumn(JobTable::number, Qt::DescendingOrder);
  view->setAccessibleName(JobsDock::tr("Jobs"));
  view->horizontalHeader()->setStretchLastSection(true);
  view->setColumnWidth(JobTable::number, 150);
  view->setColumnWidth(JobTable::name, 200);
  make_compact(*view);
  return view;
}

}  // namespace

JobsDock::JobsDock(Link& link, QWidget* parent)
    : QWidget(parent),
      link_(link),
      filter_(table_),
      view_(make_job_view(filter_)),
      open_(new QPushButton(tr("Open picture"))),
      pause_(new QPushButton(tr("Pause"))),
      cancel_(new QPushButton(tr("Cancel"))),
      note_(new QLabel) {
  auto* words = new QLineEdit;
  words->setPlaceholderText(tr("Filter"));
  words->setAccessibleName(tr("Filter"));
  words->setClearButtonEnabled(true);
  auto* own = new QCheckBox(tr("Mine"));
  own->setToolTip(tr("Only jobs that this window has sent"));
  auto* ended = new QCheckBox(tr("Hide ended"));
  auto* row = new QHBoxLayout;
  for (QWidget* one : std::initializer_list<QWidget*>{words, own, ended, open_, pause_, cancel_})
    row->addWidget(one);
  row->setStretchFactor(words, 1);
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(4, 4, 4, 4);
  layout->addLayout(row);
  layout->addWidget(view_, 1);
  layout->addWidget(note_);
  note_->setTextFormat(Qt::PlainText);
  note_->hide();

  connect(words, &QLineEdit::textChanged, &filter_, &JobFilter::set_words);
  connect(own, &QCheckBox::toggled, &filter_, &JobFilter::set_own_only);
  connect(ended, &QCheckBox::toggled, &filter_, &JobFilter::set_hide_ended);
  const auto open = [this] {
    if (const v1::JobSummary* job = chosen())
      Q_EMIT open_asked(table_.handle_of(*job), QString::fromStdString(printable(job->name())));
  };
  connect(open_, &QPushButton::clicked, this, open);
  connect(view_, &QTableView::doubleClicked, this, open);
  connect(pause_, &QPushButton::clicked, this, [this] {
    if (const v1::JobSummary* job = chosen())
      order(job->state() == v1::PAUSED ? Link::Order::resume : Link::Order::pause);
  });
  connect(cancel_, &QPushButton::clicked, this, &JobsDock::cancel);
  connect(view_->selectionModel(), &QItemSelectionModel::selectionChanged, this,
          &JobsDock::show_choices);
  connect(&table_, &QAbstractItemModel::dataChanged, this, &JobsDock::show_choices);
  connect(&timer_, &QTimer::timeout, this, &JobsDock::update_now);
  timer_.setInterval(1000);
  show_choices();
}

void JobsDock::showEvent(QShowEvent*) {
  update_now();
  timer_.start();
}

void JobsDock::hideEvent(QHideEvent*) { timer_.stop(); }

/// One question at a time: a server that is slow is not asked more.
void JobsDock::update_now() {
  if (!link_.ready() || std::exchange(asked_, true)) return;
  link_.list(this, [this](client::Answer<client::ServerJobs> jobs) {
    asked_ = false;
    note_->setVisible(!jobs);
    if (jobs)
      table_.set_jobs(jobs->list, jobs->server);
    else
      note_->setText(QString::fromStdString(printable(jobs.error().message)));
    show_choices();
  });
}

const v1::JobSummary* JobsDock::chosen() const {
  const QModelIndexList rows = view_->selectionModel()->selectedRows();
  return rows.isEmpty() ? nullptr : &table_.job(filter_.mapToSource(rows.front()).row());
}

void JobsDock::show_choices() {
  const v1::JobSummary* job = chosen();
  const bool goes_on = job != nullptr && !has_ended(job->state());
  open_->setEnabled(job != nullptr);
  pause_->setEnabled(goes_on);
  pause_->setText(job != nullptr && job->state() == v1::PAUSED ? tr("Go on") : tr("Pause"));
  cancel_->setEnabled(goes_on);
}

void JobsDock::order(Link::Order order) {
  const v1::JobSummary* job = chosen();
  if (job == nullptr) return;
  link_.control(this, order, table_.handle_of(*job), [this](client::Answer<v1::JobSummary> done) {
    note_->setVisible(!done);
    if (!done) note_->setText(QString::fromStdString(printable(done.error().message)));
    update_now();
  });
}

/// What was rendered is dropped: of another's job that is asked.
void JobsDock::cancel() {
  const v1::JobSummary* job = chosen();
  if (job == nullptr) return;
  if (!table_.is_own(*job) &&
      QMessageBox::question(
          this, tr("Cancel"),
          tr("%1 was not sent by this window. What is rendered of it will be lost.")
              .arg(QString::fromStdString(printable(job->name()))),
          QMessageBox::Yes | QMessageBox::No, QMessageBox::No) != QMessageBox::Yes)
    return;
  order(Link::Order::cancel);
}

}  // namespace metamer::gui
