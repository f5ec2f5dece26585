#include "client/gui/jobs/job_table.h"

#include <algorithm>

#include "client/tools/text/job_text.h"
#include "common/printable.h"

namespace metamer::gui {
namespace {

double share_done(const v1::JobSummary& job) {
  return job.tiles() > 0 ? 100.0 * job.tiles_done() / job.tiles() : 0;
}

QString table_text(const std::string& text) { return QString::fromStdString(printable(text)); }

}  // namespace

bool has_ended(v1::JobState state) {
  switch (state) {
    case v1::FINISHED:
    case v1::FAILED:
    case v1::CANCELLED:
      return true;
    case v1::JOB_STATE_UNSPECIFIED:
    case v1::QUEUED:
    case v1::RUNNING:
    case v1::PAUSED:
    // protobuf's own two, which no message can hold.
    case v1::JobState_INT_MIN_SENTINEL_DO_NOT_USE_:
    case v1::JobState_INT_MAX_SENTINEL_DO_NOT_USE_:
      break;
  }
  return false;
}

void JobTable::set_jobs(const v1::JobList& list, const std::string& server) {
  if (server != server_) {
    beginResetModel();
    jobs_.clear();
    server_ = server;
    endResetModel();
  }
  const auto is_listed = [&](const v1::JobSummary& job) {
    return std::any_of(list.job().begin(), list.job().end(),
                       [&](const v1::JobSummary& one) { return one.job_id() == job.job_id(); });
  };
  for (int row = rowCount() - 1; row >= 0; --row) {
    if (is_listed(job(row))) continue;
    beginRemoveRows({}, row, row);
    jobs_.erase(jobs_.begin() + row);
    endRemoveRows();
  }
  for (const v1::JobSummary& job : list.job()) {
    const auto at = std::lower_bound(
        jobs_.begin(), jobs_.end(), job,
        [](const v1::JobSummary& a, const v1::JobSummary& b) { return a.job_id() < b.job_id(); });
    const int row = static_cast<int>(at - jobs_.begin());
    if (at != jobs_.end() && at->job_id() == job.job_id()) {
      *at = job;
      Q_EMIT dataChanged(index(row, 0), index(row, columns - 1));
    } else {
      beginInsertRows({}, row, row);
      jobs_.insert(at, job);
      endInsertRows();
    }
  }
}

void JobTable::add_own(const client::JobHandle& job) {
  own_.insert(job);
  if (!jobs_.empty()) Q_EMIT dataChanged(index(0, 0), index(rowCount() - 1, columns - 1));
}

int JobTable::rowCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : static_cast<int>(jobs_.size());
}
int JobTable::columnCount(const QModelIndex& parent) const {
  return parent.isValid() ? 0 : columns;
}

QString JobTable::text(const v1::JobSummary& job, int column) const {
  switch (column) {
    case number:
      return QString::fromStdString(to_text(handle_of(job)));
    case name:
      return table_text(job.name());
    case state:
      return is_own(job) ? tr("%1, mine").arg(QString::fromUtf8(client::word(job.state())))
                         : QString::fromUtf8(client::word(job.state()));
    case done:
      return job.tiles() > 0 ? tr("%1 %").arg(share_done(job), 0, 'f', 0) : QStringLiteral("-");
    case age:
      return QString::fromStdString(client::clock(job.age()));
    case reason:
      return table_text(job.reason());
    default:
      return {};
  }
}

QVariant JobTable::data(const QModelIndex& index, int role) const {
  if (!index.isValid()) return {};
  const v1::JobSummary& one = job(index.row());
  if (role == Qt::TextAlignmentRole && (index.column() == done || index.column() == age))
    return static_cast<int>(Qt::AlignRight | Qt::AlignVCenter);
  if (role == Qt::ToolTipRole) return text(one, index.column());
  if (role == sort_role) {
    if (index.column() == number) return QVariant::fromValue<quint64>(one.job_id());
    if (index.column() == done) return share_done(one);
    if (index.column() == age) return one.age();
  }
  return role == Qt::DisplayRole || role == sort_role ? text(one, index.column()) : QVariant();
}

QVariant JobTable::headerData(int section, Qt::Orientation orientation, int role) const {
  if (orientation != Qt::Horizontal || role != Qt::DisplayRole) return {};
  const char* const names[] = {QT_TR_NOOP("Job"),  QT_TR_NOOP("Name"), QT_TR_NOOP("State"),
                               QT_TR_NOOP("Done"), QT_TR_NOOP("Age"),  QT_TR_NOOP("Why")};
  return section >= 0 && section < columns ? tr(names[section]) : QVariant();
}

JobFilter::JobFilter(JobTable& table, QObject* parent)
    : QSortFilterProxyModel(parent), table_(table) {
  setSourceModel(&table);
  setSortRole(JobTable::sort_role);
}

void JobFilter::set_words(const QString& words) {
  words_ = words.split(QLatin1Char(' '), Qt::SkipEmptyParts);
  invalidateFilter();
}

void JobFilter::set_own_only(bool own) {
  own_only_ = own;
  invalidateFilter();
}

void JobFilter::set_hide_ended(bool hide) {
  hide_ended_ = hide;
  invalidateFilter();
}

bool JobFilter::filterAcceptsRow(int row, const QModelIndex& parent) const {
  const v1::JobSummary& job = table_.job(row);
  if (own_only_ && !table_.is_own(job)) return false;
  if (hide_ended_ && has_ended(job.state())) return false;
  QString all;
  for (int column = 0; column < JobTable::columns; ++column)
    all += table_.index(row, column, parent).data().toString() + QLatin1Char('\n');
  return std::all_of(words_.begin(), words_.end(),
                     [&](const QString& word) { return all.contains(word, Qt::CaseInsensitive); });
}

}  // namespace metamer::gui
