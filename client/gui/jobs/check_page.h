#pragma once

#include <QFormLayout>
#include <QTableWidget>
#include <QWidget>
#include <memory>
#include <vector>

#include "client/gui/jobs/job_panel.h"
#include "client/gui/jobs/job_watch.h"
#include "common/scene/scene_file.h"

namespace metamer::gui {

/// A scene that the server reads, plans and prepares, without a picture: the stages while it lasts,
/// then what each took, what the scene needs, and what is to be known of it.
class CheckPage : public QWidget {
  Q_OBJECT
 public:
  CheckPage(Link& link, QWidget* parent = nullptr);
  void check(const v1::Scene& scene, const std::vector<Asset>& assets, const QString& name);
  void cancel();

  const QString& name() const { return name_; }
  QString title() const { return tr("Check: %1 %2").arg(name_, panel_->mark()); }
  const JobPanel& panel() const { return *panel_; }
  const QTableWidget& times() const { return *times_; }

 Q_SIGNALS:
  void titled();
  /// "preparing: reading", "ready: reading 0.120 s, tables 0.001 s": for the status bar.
  void stage(const QString& text);

 private:
  void take(const v1::JobEvent& event);
  void show_times(const v1::Timing& timing);
  void show_needs(const v1::Plan& plan);

  Link& link_;
  JobPanel* panel_;
  QTableWidget* times_;
  QLabel *needed_, *unneeded_;
  QString name_;
  client::JobHandle job_;
};

}  // namespace metamer::gui
