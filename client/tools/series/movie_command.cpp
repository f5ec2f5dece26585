#include "client/tools/series/movie_command.h"

#include <limits>

#include "client/tools/text/formatted.h"

namespace metamer::client {
namespace {

/// A word of a shell. `format`: one that printf reads.
std::string shell_word(const std::string& words, bool format) {
  std::string text = "'";
  for (const char c : words) {
    if (c == '\'') {
      text += "'\\''";
      continue;
    }
    if (c == '\\' && format) text += c;
    text += c;
  }
  return text + "'";
}

/// Whether ffmpeg's own patterns mean the same files: they count by ones in an int, fill up with
/// zeros alone, and take %* and a: for something else.
bool is_sequence(const FrameName& name, const std::vector<std::uint32_t>& frames) {
  const std::string& pattern = name.pattern();
  return frames[1] - frames[0] == 1 && name.fills_with_zeros() &&
         frames.back() <= std::numeric_limits<std::int32_t>::max() &&
         pattern.find("%%") == std::string::npos && pattern.find(':') == std::string::npos;
}

}  // namespace

std::string movie_command(const FrameName& name, const std::vector<std::uint32_t>& frames,
                          bool even) {
  std::string text;
  if (is_sequence(name, frames)) {
    // There may be further files, of an earlier series.
    text = formatted("ffmpeg -framerate 24 -start_number %u -i ", frames[0]) +
           shell_word(name.pattern(), false) + formatted(" -frames:v %zu", frames.size());
  } else {
    text = formatted("for n in $(seq %u %u %u); do cat -- \"$(printf -- ", frames[0],
                     frames[1] - frames[0], frames.back()) +
           shell_word(name.pattern(), true) +
           " \"$n\")\"; done | ffmpeg -framerate 24 -f image2pipe -c:v png -i -";
  }
  // H.264's usual colours come in squares of two pixels.
  if (!even) text += " -vf 'pad=ceil(iw/2)*2:ceil(ih/2)*2'";
  return text + " -pix_fmt yuv420p turntable.mp4";
}

}  // namespace metamer::client
