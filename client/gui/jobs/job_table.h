#pragma once

#include <QAbstractTableModel>
#include <QSortFilterProxyModel>
#include <set>
#include <string>
#include <vector>

#include "client/session/job_handle.h"
#include "metamer/v1/jobs.pb.h"

namespace metamer::gui {

/// Whether nothing more will come of a job.
bool has_ended(v1::JobState state);

/// All jobs of a server, oldest first.
class JobTable : public QAbstractTableModel {
  Q_OBJECT
 public:
  enum Column { number, name, state, done, age, reason, columns };
  using QAbstractTableModel::QAbstractTableModel;

  /// The newest list, by rising numbers, of a server (as JobHandle::server). Rows of jobs that were
  /// there before stay; of another server none were.
  void set_jobs(const v1::JobList& list, const std::string& server = {});
  /// A job that this window sent.
  void add_own(const client::JobHandle& job);
  bool is_own(const v1::JobSummary& job) const { return own_.contains(handle_of(job)); }
  /// Of one that is listed.
  client::JobHandle handle_of(const v1::JobSummary& job) const { return {job.job_id(), server_}; }
  const v1::JobSummary& job(int row) const { return jobs_[static_cast<std::size_t>(row)]; }

  int rowCount(const QModelIndex& parent = {}) const override;
  int columnCount(const QModelIndex& parent = {}) const override;
  QVariant data(const QModelIndex& index, int role) const override;
  QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  /// Of data(): numbers as numbers, to sort by.
  static constexpr int sort_role = Qt::UserRole;

 private:
  QString text(const v1::JobSummary& job, int column) const;

  std::vector<v1::JobSummary> jobs_;
  std::string server_;
  std::set<client::JobHandle> own_;
};

/// Those of them that somebody wants to see.
class JobFilter : public QSortFilterProxyModel {
  Q_OBJECT
 public:
  explicit JobFilter(JobTable& table, QObject* parent = nullptr);
  void set_words(const QString& words);
  void set_own_only(bool own);
  void set_hide_ended(bool hide);

 protected:
  /// All words stand somewhere in the row.
  bool filterAcceptsRow(int row, const QModelIndex& parent) const override;

 private:
  JobTable& table_;
  QStringList words_;
  bool own_only_ = false, hide_ended_ = false;
};

}  // namespace metamer::gui
