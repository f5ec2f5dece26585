#include "client/tools/series/frame_name.h"

#include <charconv>
#include <optional>
#include <string_view>

namespace metamer::client {
namespace {

std::optional<std::uint32_t> whole_number(std::string_view text) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

Result<FrameName> FrameName::parse(const std::string& pattern) {
  FrameName name;
  name.pattern_ = pattern;
  bool found = false;
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    std::string& part = found ? name.after_ : name.before_;
    if (pattern[i] != '%') {
      part += pattern[i];
      continue;
    }
    if (++i < pattern.size() && pattern[i] == '%') {
      part += '%';
      continue;
    }
    const bool zero = i < pattern.size() && pattern[i] == '0';
    i += zero;
    const bool wide = i < pattern.size() && '1' <= pattern[i] && pattern[i] <= '9';
    if (wide) name.width_ = static_cast<unsigned>(pattern[i] - '0');
    i += wide;
    if (i >= pattern.size() || pattern[i] != 'd')
      return problem(quoted(pattern) + " has a % that begins no number such as %04d (%% is a per " +
                     "cent sign)");
    if (found) return problem(quoted(pattern) + " has places for two numbers");
    if (zero) name.fill_ = '0';
    found = true;
  }
  if (!found)
    return problem(quoted(pattern) + " has no place for the frame's number, such as %04d");
  return name;
}

std::string FrameName::of(std::uint32_t number) const {
  const std::string digits = std::to_string(number);
  const std::size_t fill = digits.size() < width_ ? width_ - digits.size() : 0;
  return before_ + std::string(fill, fill_) + digits + after_;
}

Result<std::vector<std::uint32_t>> parse_frames(const std::string& text) {
  std::vector<std::uint32_t> numbers;
  for (std::string_view rest = text;;) {
    const std::size_t colon = rest.find(':');
    const auto number = whole_number(rest.substr(0, colon));
    if (!number)
      return problem(quoted(text) + " is not FIRST:LAST or FIRST:LAST:STEP, such as 0:359");
    numbers.push_back(*number);
    if (colon == std::string_view::npos) break;
    rest.remove_prefix(colon + 1);
  }
  if (numbers.size() > 3)
    return problem(quoted(text) + " is not FIRST:LAST or FIRST:LAST:STEP, such as 0:359");
  const std::uint32_t first = numbers[0], last = numbers.size() > 1 ? numbers[1] : first;
  const std::uint32_t step = numbers.size() > 2 ? numbers[2] : 1;
  if (step == 0) return problem(quoted(text) + " has a step of 0");
  if (last < first) return problem(quoted(text) + " ends before it begins");
  if ((last - first) / step >= max_frames)
    return problem(quoted(text) + " has more than " + std::to_string(max_frames) + " frames");
  std::vector<std::uint32_t> frames;
  for (std::uint64_t frame = first; frame <= last; frame += step)
    frames.push_back(static_cast<std::uint32_t>(frame));
  return frames;
}

}  // namespace metamer::client
