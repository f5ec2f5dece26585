#include "client/cli/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <iostream>
#include <utility>

#include "client/cli/report.h"
#include "client/tools/text/formatted.h"
#include "client/tools/text/job_text.h"
#include "common/printable.h"

namespace metamer::cli {

namespace {

/// The picture is whole, and its pixels are compared with the reference's.
bool is_check(const v1::Progress& progress) { return progress.tiles_verified() > 0; }

unsigned percent(const v1::Progress& progress) {
  if (progress.tiles() == 0) return 0;
  const std::uint64_t done = is_check(progress) ? progress.tiles_verified() : progress.tiles_done();
  return std::min(100u, static_cast<unsigned>(100 * done / progress.tiles()));
}

int terminal_columns() {
  winsize size{};
  constexpr int usual = 80;
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

}  // namespace

std::string bar(const v1::Progress& progress, int columns) {
  return bar(
      percent(progress),
      (is_check(progress) ? std::string("verified") : rate(progress.rays(), progress.seconds())) +
          "  " + clock(progress.seconds_left()) + " left",
      columns);
}

std::string bar(unsigned percent, const std::string& words, int columns) {
  const std::string tail = formatted("  %3u %%  ", percent) + words;
  constexpr int widest = 40;  // the rest of a wide terminal would only make the eye travel
  const int width = std::min(columns - static_cast<int>(tail.size()) - 3, widest);
  if (width < 5) return tail.substr(2, static_cast<std::size_t>(std::max(columns - 1, 0)));
  const auto filled = static_cast<std::size_t>(width) * percent / 100;
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
  say(std::cerr, text);
}

/// On the terminal's last line.
void ProgressView::draw(const std::string& bar) {
  std::cerr << "\r\033[K" << bar << std::flush;
  drawn_ = true;
}

void ProgressView::show(double share, const std::string& words) {
  const auto percent = static_cast<unsigned>(100 * std::clamp(share, 0.0, 1.0));
  if (terminal_) return draw(bar(percent, words, terminal_columns()));
  if (percent / 10 <= tenths_ || percent >= 100) return;
  tenths_ = percent / 10;
  line(formatted("%u %%, ", percent) + words);
}

void ProgressView::show_progress(const v1::Progress& progress) {
  if (terminal_) {
    draw(bar(progress, terminal_columns()));
  } else {
    show_line(progress);
  }
}

void ProgressView::show_line(const v1::Progress& progress) {
  const unsigned tenths = percent(progress) / 10;
  if (is_check(progress) && !std::exchange(checks_, true)) tenths_ = 0;
  if (tenths <= tenths_ || tenths >= 10) return;
  tenths_ = tenths;
  line(formatted("%u %%, ", percent(progress)) +
       (is_check(progress) ? std::string("verified") : rate(progress.rays(), progress.seconds())) +
       ", " + clock(progress.seconds_left()) + " left");
}

void ProgressView::show(const v1::JobEvent& event) {
  switch (event.event_case()) {
    case v1::JobEvent::kQueued:
      if (event.queued().position() > 0)
        line("queued: " + counted(event.queued().position(), "other job waits", "other jobs wait") +
             " or " + (event.queued().position() == 1 ? "runs" : "run") + ", and users have turns");
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
      line("retrying: " + printable(event.retrying().reason()));
      break;
    case v1::JobEvent::kFinished:
      line("done: " + describe(event.finished().timing()));
      break;
    case v1::JobEvent::kPreparing:
      if (terminal_) draw(word(event.preparing().stage()) + std::string(" …"));
      break;
    case v1::JobEvent::kPrepared:
      clear_bar();
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
