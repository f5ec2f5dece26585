#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/problem.h"

namespace metamer::client {

/// How the files of numbered pictures are called: "frames/booth-%04d.png".
class FrameName {
 public:
  /// Reads a pattern with one %d, %4d or %04d, up to %09d; %% is a per cent sign. Error: it has
  /// none, several, or another thing after a %.
  static Result<FrameName> parse(const std::string& pattern);

  std::string of(std::uint32_t number) const;
  /// Short numbers, where they are filled up at all.
  bool fills_with_zeros() const { return width_ == 0 || fill_ == '0'; }
  const std::string& pattern() const { return pattern_; }

 private:
  std::string pattern_, before_, after_;
  unsigned width_ = 0;
  char fill_ = ' ';
};

/// "0:359", "0:350:10", "7": from the first to the last by a step of at least 1. Errors: it is none
/// of these, it goes backwards, or it is of more than max_frames.
Result<std::vector<std::uint32_t>> parse_frames(const std::string& text);
inline constexpr std::uint32_t max_frames = 100'000;  ///< As a server takes them in one series.

}  // namespace metamer::client
