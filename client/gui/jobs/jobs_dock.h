#pragma once

#include <QLabel>
#include <QPushButton>
#include <QTableView>
#include <QTimer>
#include <QWidget>

#include "client/gui/jobs/job_table.h"
#include "client/gui/link/link.h"

namespace metamer::gui {

/// The jobs of all who use the server, once a second while they are seen.
class JobsDock : public QWidget {
  Q_OBJECT
 public:
  explicit JobsDock(Link& link, QWidget* parent = nullptr);

  JobTable& table() { return table_; }
  const QTableView& view() const { return *view_; }
  /// Asks anew.
  void update_now();

 Q_SIGNALS:
  void open_asked(const client::JobHandle& job, const QString& name);

 protected:
  void showEvent(QShowEvent*) override;
  void hideEvent(QHideEvent*) override;

 private:
  /// Of the row that is chosen; null: none is.
  const v1::JobSummary* chosen() const;
  void order(Link::Order order);
  void cancel();
  void show_choices();

  Link& link_;
  JobTable table_;
  JobFilter filter_;
  QTableView* view_;
  QPushButton *open_, *pause_, *cancel_;
  QLabel* note_;
  QTimer timer_;
  bool asked_ = false;
};

}  // namespace metamer::gui
