#include "common/problem.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>

#include "common/printable.h"

namespace metamer {
namespace {

constexpr std::size_t max_source_width = 100;  // Bytes of a source line that a terminal shows well.
constexpr std::size_t max_quoted = 60;
constexpr std::size_t max_name =
    200;  // Longer ones are no typing mistakes, and cost n² to compare.

bool is_continuation(char c) { return (static_cast<unsigned char>(c) & 0xC0u) == 0x80u; }

/// Moves `position` back to the first byte of the character that it is in.
std::size_t character_start(std::string_view text, std::size_t position) {
  while (position > 0 && position < text.size() && is_continuation(text[position])) --position;
  return position;
}

/// Line `number` (from 1) of `source` without its end; nothing when it has no such line.
std::string_view source_line(std::string_view source, int number) {
  for (int i = 1; i < number; ++i) {
    const std::size_t end = source.find('\n');
    if (end == std::string_view::npos) return {};
    source.remove_prefix(end + 1);
  }
  source = source.substr(0, source.find('\n'));
  if (source.ends_with('\r')) source.remove_suffix(1);
  return source;
}

/// The source line and, below it, the caret; the part around the caret where the line is long.
std::string excerpt(std::string_view line, std::size_t column) {
  // Choose the part that is shown.
  const std::size_t caret = std::min(column > 0 ? column - 1 : 0, line.size());
  std::size_t begin = 0;
  std::size_t end = line.size();
  if (line.size() > max_source_width) {
    const std::size_t ahead = max_source_width * 2 / 3;
    begin = caret > ahead ? character_start(line, caret - ahead) : 0;
    end = character_start(line, std::min(line.size(), begin + max_source_width));
  }

  // Write it, and a blank of the same width for each character before the caret.
  const std::string head = begin > 0 ? "…" : "";
  const std::string tail = end < line.size() ? "…" : "";
  std::string result = "\n" + head + printable(line.substr(begin, end - begin), "\t") + tail;
  if (column == 0) return result;
  result += begin > 0 ? "\n " : "\n";
  for (const char c : line.substr(begin, caret - begin)) {
    if (!is_continuation(c)) result += c == '\t' ? '\t' : ' ';
  }
  return result + "^";
}

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Optimal string alignment: insert, delete, change one, or swap two neighbours.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  std::iota(last.begin(), last.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
          lower(a[i - 2]) == lower(b[j - 1])) {
        row[j] = std::min(row[j], before[j - 2] + 1);
      }
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::string format(const Problem& problem, std::string_view source) {
  // Say where it is, as far as that is known.
  std::string text;
  if (!problem.file.empty()) {
    text += printable(problem.file);
    if (problem.line > 0) text += ":" + std::to_string(problem.line);
    if (problem.line > 0 && problem.column > 0) text += ":" + std::to_string(problem.column);
    text += ": ";
  }
  text += "error: ";
  if (problem.line <= 0 && !problem.field.empty()) text += printable(problem.field) + ": ";
  text += printable(problem.message);

  // Show the line.
  if (problem.line <= 0 || problem.column < 0) return text;
  const std::string_view line = source_line(source, problem.line);
  if (!line.empty()) text += excerpt(line, static_cast<std::size_t>(problem.column));
  return text;
}

std::string best_match(std::string_view name, const std::vector<std::string>& known) {
  if (name.empty() || name.size() > max_name) return {};
  std::size_t closest = std::max<std::size_t>(1, name.size() / 3) + 1;
  const std::string* best = nullptr;
  for (const std::string& candidate : known) {
    if (candidate.empty() || candidate.size() >= name.size() + closest) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance >= closest) continue;
    closest = distance;
    best = &candidate;
  }
  return best != nullptr ? *best : std::string();
}

std::string did_you_mean(std::string_view name, const std::vector<std::string>& known) {
  return unknown_name({}, name, known).message;
}

Problem unknown_name(std::string message, std::string_view name,
                     const std::vector<std::string>& known) {
  Problem problem{.field = {}, .file = {}, .message = std::move(message)};
  problem.meant = best_match(name, known);
  if (problem.meant.empty()) return problem;
  problem.was = name;
  problem.message += "; did you mean " + quoted(problem.meant) + "?";
  return problem;
}

std::string quoted(std::string_view text) {
  if (text.size() <= max_quoted) return "\"" + printable(text) + "\"";
  return "\"" + printable(text.substr(0, character_start(text, max_quoted))) + "…\"";
}

std::string number_text(double value) {
  std::array<char, 32> buffer{};
  const auto [end, error] = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return {buffer.data(), end};
}

}  // namespace metamer
