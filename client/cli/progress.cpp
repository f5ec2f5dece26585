#include "client/cli/progress.h"
#include "client/cli/print.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "common/scene/methods.h"

namespace metamer::cli {
namespace {

std::string counted(std::uint64_t count, const char* one, const char* many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

std::string rate(std::uint64_t rays, double seconds) {
  return seconds > 0 ? print("%.1f Mrays/s", static_cast<double>(rays) / seconds * 1e-6)
                     : std::string("- Mrays/s");
}

unsigned percent(const v1::Progress& progress) {
  if (progress.tiles() == 0) return 0;
  return std::min(100u, static_cast<unsigned>(100ull * progress.tiles_done() / progress.tiles()));
}

int terminal_columns() {
  winsize size{};
  constexpr int usual = 80;
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

}  // namespace

std::string clock(double seconds) {
  // A count that is no sensible time is no time.
  if (!(seconds >= 0 && seconds < 1e6)) return "-:--";
  const long whole = std::lround(std::ceil(seconds));
  return whole < 3600 ? print("%ld:%02ld", whole / 60, whole % 60)
                      : print("%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string describe(const v1::Plan& plan) {
  std::string text = print("%ux%u, ", plan.width(), plan.height());
  text += counted(plan.spp(), "sample", "samples") + " per pixel, ";
  text += planned_method_text(plan) + ", ";
  if (plan.backend() != "cpu") text += "by the " + plan.backend() + " backend, ";
  text += counted(plan.lights(), "light", "lights") + ", ";
  text += counted(plan.materials(), "material", "materials") + ", ";
  text += counted(plan.triangles(), "triangle", "triangles") + ", ";
  text += counted(plan.threads(), "thread", "threads");
  return text;
}

std::string describe(const v1::Timing& timing) {
  return print("%.2f s rendering (", timing.render()) + rate(timing.rays(), timing.render()) +
         print("), %.2f s in all", timing.total());
}

std::string bar(const v1::Progress& progress, int columns) {
  const std::string tail = print("  %3u %%  ", percent(progress)) +
                           rate(progress.rays(), progress.seconds()) + "  " +
                           clock(progress.seconds_left()) + " left";
  constexpr int widest = 40;  // the rest of a wide terminal would only make the eye travel
  const int width = std::min(columns - static_cast<int>(tail.size()) - 3, widest);
  if (width < 5) return tail.substr(2, static_cast<std::size_t>(std::max(columns - 1, 0)));
  const auto filled = static_cast<std::size_t>(width) * percent(progress) / 100;
  return '[' + std::string(filled, '#') +
         std::string(static_cast<std::size_t>(width) - filled, '-') + ']' + tail;
}

ProgressView::ProgressView() : terminal_(isatty(STDERR_FILENO) == 1) {}

ProgressView::~ProgressView() { clear_bar(); }

void ProgressView::clear_bar() {
  if (drawn_) std::cerr << "\r\033[K" << std::flush;
  drawn_ = false;
}

void ProgressView::line(const std::string& text) {
  clear_bar();
  std::cerr << text << '\n';
}

void ProgressView::show_progress(const v1::Progress& progress) {
  if (terminal_) {
    std::cerr << "\r\033[K" << bar(progress, terminal_columns()) << std::flush;
    drawn_ = true;
  } else {
    show_line(progress);
  }
}

void ProgressView::show_line(const v1::Progress& progress) {
  const unsigned tenths = percent(progress) / 10;
  if (tenths <= tenths_ || tenths >= 10) return;
  tenths_ = tenths;
  line(print("%u %%, ", percent(progress)) + rate(progress.rays(), progress.seconds()) + ", " +
       clock(progress.seconds_left()) + " left");
}

void ProgressView::show(const v1::JobEvent& event) {
  switch (event.event_case()) {
    case v1::JobEvent::kQueued:
      if (event.queued().position() > 0)
        line("queued behind " + counted(event.queued().position(), "job", "jobs"));
      break;
    case v1::JobEvent::kPlanned:
      line("planned: " + describe(event.planned().plan()));
      break;
    case v1::JobEvent::kProgress:
      show_progress(event.progress());
      break;
    case v1::JobEvent::kPaused:
      line("paused");
      break;
    case v1::JobEvent::kRetrying:
      line("retrying: " + event.retrying().reason());
      break;
    case v1::JobEvent::kFinished:
      line("done: " + describe(event.finished().timing()));
      break;
    case v1::JobEvent::kStarted:
    case v1::JobEvent::kTile:
    case v1::JobEvent::kPreview:
    case v1::JobEvent::kFailed:     // whoever follows the job tells these two,
    case v1::JobEvent::kCancelled:  // with their exit codes
    case v1::JobEvent::EVENT_NOT_SET:
      break;
  }
}

}  // namespace metamer::cli
