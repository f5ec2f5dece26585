#pragma once

#include <QMessageBox>
#include <QObject>
#include <QPointer>
#include <QTimer>

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// A private server ends with the window, and its jobs with it: where some have not ended, closing
/// the window asks whether to wait for them, to cancel them, or to stay.
class QuitQuestion : public QObject {
  Q_OBJECT
 public:
  explicit QuitQuestion(MainWindow& window);

  bool eventFilter(QObject* watched, QEvent* event) override;
  QMessageBox* box() const { return box_; }  ///< Null: nothing is asked.

  /// A server that says nothing for so long keeps no window open.
  static constexpr std::chrono::seconds patience{2};

 private:
  void look();
  void take(const client::Answer<client::ServerJobs>& jobs);
  void ask(const QString& jobs);
  void answer(QMessageBox* box);
  void close();

  enum class State { open, asking, waiting, closing };
  State state_ = State::open;
  MainWindow& window_;
  QPointer<QMessageBox> box_;
  QTimer timer_;        ///< Until the server is asked again, or given up.
  bool listed_ = true;  ///< The server has answered.
};

}  // namespace metamer::gui
