#pragma once

#include <sys/syscall.h>
#include <unistd.h>

#include <QElapsedTimer>
#include <QTimer>
#include <algorithm>
#include <fstream>
#include <string>

namespace metamer::gui {

/// Watches the loop of events of its thread: a beat that comes late shows that something kept it.
/// What a busy machine does to it is told apart: a thread that computes or waits for a processor
/// (schedstat counts both) does not wait for the network or a file.
class StallWatch {
 public:
  StallWatch() {
    beat_.setTimerType(Qt::PreciseTimer);
    QObject::connect(&beat_, &QTimer::timeout, &beat_, [this] { take(); });
    beat_.start(interval);
    busy_ = busy();
    between_.start();
  }

  /// ms between two beats, at most; and how much of such a time the thread slept, at most.
  double longest() const { return longest_; }
  double slept() const { return slept_; }

 private:
  static constexpr int interval = 5;  // ms

  void take() {
    const double gone = static_cast<double>(between_.nsecsElapsed()) * 1e-6;
    const double now = busy();
    longest_ = std::max(longest_, gone - interval);
    slept_ = std::max(slept_, gone - (now - busy_) - interval);
    between_.start();
    busy_ = now;
  }

  /// ms that this thread computed or waited for a processor.
  static double busy() {
    std::ifstream file("/proc/self/task/" + std::to_string(syscall(SYS_gettid)) + "/schedstat");
    double computed = 0, waited = 0;
    file >> computed >> waited;
    return (computed + waited) * 1e-6;
  }

  QTimer beat_;
  QElapsedTimer between_;
  double busy_ = 0, longest_ = 0, slept_ = 0;
};

}  // namespace metamer::gui
