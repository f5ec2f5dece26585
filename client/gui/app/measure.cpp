#include "client/gui/app/measure.h"

#include <malloc.h>
#include <unistd.h>

#include <QApplication>
#include <QEvent>
#include <QTimer>
#include <cstdio>
#include <ctime>
#include <fstream>

#include "client/gui/app/main_window.h"
#include "client/tools/scene/camera_motion.h"

namespace metamer::gui {
namespace {

/// Seconds of this thread.
double thread_cpu() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// MiB that this process has in memory.
double resident() {
  std::ifstream file("/proc/self/statm");
  long all = 0, here = 0;
  file >> all >> here;
  return static_cast<double>(here) * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// What lies ready for later is given back first: what is left is in use.
void print_memory(const char* when, int count, const char* what) {
  malloc_trim(0);
  const struct mallinfo2 heap = mallinfo2();
  std::printf("memory %-6s %6d %-9s      %7.1f MiB, of which the heap has %.1f\n", when, count,
              what, resident(), static_cast<double>(heap.uordblks + heap.hblkhd) / (1 << 20));
  std::fflush(stdout);
}

constexpr int warm_up = 20;  // frames before memory and time are looked at
constexpr int first = 10;    // documents before memory is looked at

}  // namespace

Measure::Measure(MainWindow& window, const QElapsedTimer& since, MeasureCounts counts)
    : QObject(&window), window_(window), since_(since), counts_(counts) {
  window_.installEventFilter(this);
  if (window_.document() != nullptr) scene_ = window_.document()->path();
  watch();
}

void Measure::watch() {
  if (window_.live() != nullptr)
    connect(window_.live(), &LivePage::framed, this, &Measure::take_frame);
}

bool Measure::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Paint && !std::exchange(drawn_, true))
    std::printf("a drawn window after          %7lld ms\n",
                static_cast<long long>(since_.elapsed()));
  return QObject::eventFilter(watched, event);
}

void Measure::take_frame() {
  if (seen_++ == 0)
    std::printf("the first frame after         %7lld ms\n",
                static_cast<long long>(since_.elapsed()));
  if (seen_ == warm_up) {
    turning_.start();
    cpu_before_ = thread_cpu();
    print_memory("before", counts_.frames, "frames");
  }
  if (seen_ < warm_up + counts_.frames)
    return window_.live()->set_camera(client::orbit(window_.live()->camera(), 1));
  if (seen_ == warm_up + counts_.frames) end_frames();
  // A page must not go while it says that it has a frame.
  window_.live()->disconnect(this);
  QTimer::singleShot(0, this, &Measure::exchange_document);
}

void Measure::end_frames() {
  const double seconds = 1e-3 * static_cast<double>(turning_.elapsed());
  print_memory("after", counts_.frames, "frames");
  std::printf("frames a second               %7.1f\n", counts_.frames / seconds);
  std::printf("CPU of the window's thread    %7.2f ms a frame\n",
              1000 * (thread_cpu() - cpu_before_) / counts_.frames);
}

void Measure::exchange_document() {
  window_.close_scene(0);
  if (opened_ == first) print_memory("before", counts_.documents, "documents");
  if (opened_ == first + counts_.documents) {
    print_memory("after", counts_.documents, "documents");
    return QApplication::exit();
  }
  ++opened_;
  window_.open(scene_);
  watch();
}

}  // namespace metamer::gui
