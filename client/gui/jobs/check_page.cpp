#include "client/gui/jobs/check_page.h"

#include <QHeaderView>
#include <QVBoxLayout>

#include "client/gui/jobs/job_words.h"
#include "client/gui/spectra/compact_table.h"
#include "client/session/submission.h"
#include "common/printable.h"

namespace metamer::gui {
namespace {

QString one_a_line(const google::protobuf::RepeatedPtrField<std::string>& texts) {
  QStringList lines;
  for (const std::string& text : texts) lines << QString::fromStdString(printable(text));
  return lines.join(QLatin1Char('\n'));
}

QLabel* add_lines(QFormLayout& rows, const QString& name) {
  auto* label = new QLabel(QStringLiteral("-"));
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  rows.addRow(name, label);
  return label;
}

}  // namespace

CheckPage::CheckPage(Link& link, QWidget* parent)
    : QWidget(parent), link_(link), panel_(new JobPanel), times_(new QTableWidget(0, 2)) {
  panel_->set_check();
  times_->setHorizontalHeaderLabels({tr("Step"), tr("Seconds")});
  times_->setAccessibleName(tr("Times"));
  times_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  times_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  make_compact(*times_);
  auto* rows = new QFormLayout;
  needed_ = add_lines(*rows, tr("Needed"));
  unneeded_ = add_lines(*rows, tr("Left out"));
  auto* layout = new QVBoxLayout(this);
  layout->addWidget(panel_);
  layout->addWidget(times_, 1);
  layout->addLayout(rows);
  connect(panel_, &JobPanel::marked, this, &CheckPage::titled);
  connect(panel_, &JobPanel::cancel_asked, this, &CheckPage::cancel);
}

void CheckPage::check(const v1::Scene& scene, const std::vector<Asset>& assets,
                      const QString& name) {
  name_ = name;
  panel_->show_state(tr("sending"));
  client::Submission submission = client::make_submission(scene, assets, name.toStdString(), true);
  submission.request.set_prepare(true);
  link_.submit(this, std::move(submission), [this](client::Answer<client::JobHandle> job) {
    if (!job) return panel_->show_error(job.error());
    job_ = *job;
    auto* watch = new JobWatch(link_, *job, client::JobParts::plan, this);
    connect(watch, &JobWatch::event, this, [this](const auto& event) { take(*event); });
    connect(watch, &JobWatch::lost, this,
            [this](const auto& error) { panel_->show_error(*error); });
  });
}

void CheckPage::cancel() {
  if (job_.number == 0 || panel_->ended()) return;
  link_.control(this, Link::Order::cancel, job_, [](const auto&) {});
}

void CheckPage::take(const v1::JobEvent& event) {
  panel_->take(event);
  if (event.has_planned()) show_needs(event.planned().plan());
  if (event.has_prepared()) return show_times(event.prepared().timing());
  if (const QString text = state_text(event); !text.isEmpty() && !event.has_finished())
    Q_EMIT stage(text);
}

void CheckPage::show_times(const v1::Timing& timing) {
  v1::Timing whole = timing;
  whole.set_total(timing.compile() + timing.acceleration() + timing.pilot() + timing.prepare());
  const auto rows = timing_rows(whole);
  times_->setRowCount(static_cast<int>(rows.size()));
  QStringList texts;
  for (int i = 0; i < times_->rowCount(); ++i) {
    times_->setItem(i, 0, new QTableWidgetItem(rows[i].first));
    auto* seconds = new QTableWidgetItem(QString::number(rows[i].second, 'f', 4));
    seconds->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    times_->setItem(i, 1, seconds);
    texts << QStringLiteral("%1 %2").arg(rows[i].first, seconds_text(rows[i].second));
  }
  Q_EMIT stage(tr("ready: %1").arg(texts.join(QStringLiteral(", "))));
}

void CheckPage::show_needs(const v1::Plan& plan) {
  needed_->setText(one_a_line(plan.need()));
  unneeded_->setText(one_a_line(plan.unneeded()));
}

}  // namespace metamer::gui
