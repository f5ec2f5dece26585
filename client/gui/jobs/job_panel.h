#pragma once

#include <QFormLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QWidget>
#include <optional>

#include "client/gui/log/log.h"
#include "client/session/error.h"
#include "metamer/v1/jobs.pb.h"
#include "metamer/v1/plan.pb.h"

namespace metamer::gui {

/// How a job stands: progress, rate and time left, its configuration, what is to be known of it,
/// and at its end what came of the promise, and where the time went. Pauses and cancels.
class JobPanel : public QWidget {
  Q_OBJECT
 public:
  explicit JobPanel(QWidget* parent = nullptr);

  /// Before there are events: "sending …".
  void show_state(const QString& text);
  void take(const v1::JobEvent& event);
  /// Something that is to be known besides the plan's notices: why no factors are kept.
  void add_note(const QString& note, LogKind kind = LogKind::note);
  /// Of a job without a picture, which is over soon, on a page that shows its times itself.
  void set_check() {
    check_ = true;
    pause_->hide();
  }
  /// Why it can't be paused; empty: it can.
  void forbid_pause(const QString& why);
  /// Why nothing is heard of it for now; empty: it is heard of again.
  void set_interrupted(const QString& why);
  /// Nothing more will come.
  void show_error(const client::SessionError& error);

  bool ended() const { return ended_; }
  bool paused() const { return paused_; }
  /// "63 %", "✓", "✗", "…": for a tab.
  const QString& mark() const { return mark_; }
  QString state() const { return state_->text(); }

 Q_SIGNALS:
  void pause_asked();  ///< Or to go on, where it is paused.
  void cancel_asked();
  void exact_asked();  ///< The same picture by the method exact.
  void marked();
  /// Each thing that is shown as text but for figures that change.
  void said(LogKind kind, const QString& text);

 private:
  QLabel* add_row(const QString& name);
  void take_planned(const v1::Plan& plan);
  void take_progress(const v1::Progress& progress);
  void take_finished(const v1::Finished& finished);
  void end(const QString& mark);
  void set_mark(const QString& mark);
  void set_paused(bool paused);
  void show_notes();

  QLabel *state_, *speed_;
  QProgressBar* bar_;
  QPushButton *pause_, *cancel_, *exact_;
  QFormLayout* rows_;
  QLabel *configuration_, *notes_, *promise_, *times_;
  QStringList own_notes_, plan_notes_;
  std::optional<v1::Plan> plan_;
  bool ended_ = false, paused_ = false, check_ = false;
  QString mark_;
  QString before_;  ///< Its state, while it is interrupted.
};

}  // namespace metamer::gui
