#pragma once

#include <string>

#include "client/cli/names.h"
#include "metamer/v1/jobs.pb.h"

namespace metamer::cli {

/// "[####------]  40 %  12.3 Mrays/s  0:07 left", at most `columns` wide.
std::string bar(const v1::Progress& progress, int columns);

/// The same of anything else, whose `words` come after the per cent.
std::string bar(unsigned percent, const std::string& words, int columns);

/// Tells a person how a job gets on, on stderr: a bar that redraws itself on a terminal, else a
/// line now and then (planned, each tenth, done), so that a log stays short.
class ProgressView {
 public:
  ProgressView();
  ProgressView(const ProgressView&) = delete;
  ProgressView& operator=(const ProgressView&) = delete;
  ~ProgressView();

  void show(const v1::JobEvent& event);
  /// How far something else is, 0 to 1: "[###-----]  words", or without a terminal the words at
  /// each tenth.
  void show(double share, const std::string& words);
  /// A line of its own, above the bar.
  void line(const std::string& text);
  /// Makes room for others' lines: the bar comes back with the next news.
  void clear() { clear_bar(); }

 private:
  void draw(const std::string& bar);
  void show_progress(const v1::Progress& progress);
  void show_line(const v1::Progress& progress);
  void clear_bar();

  bool terminal_;
  bool drawn_ = false;   ///< A bar stands on the terminal's last line.
  unsigned tenths_ = 0;  ///< Those that were told,
  bool checks_ = false;  ///< of the check.
};

}  // namespace metamer::cli
