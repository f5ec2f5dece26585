#include "common/mesh/obj/lines.h"

#include <algorithm>
#include <cstring>

#include "common/mesh/text.h"

namespace metamer::obj {
namespace {

bool goes_on(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line.ends_with('\\');
}

bool is_comment(std::string_view line) {
  const char* const end = line.data() + line.size();
  const char* const first = mesh_text::skip_space(line.data(), end);
  return first != end && *first == '#';
}

}  // namespace

char line_end(std::string_view text) {
  const std::size_t first = text.find_first_of("\r\n");
  const bool cr = first != text.npos && text[first] == '\r' && text.substr(first, 2) != "\r\n";
  return cr ? '\r' : '\n';
}

std::size_t piece_end(std::string_view text, std::size_t at, char line_end) {
  while (at < text.size()) {
    const std::size_t end = text.find(line_end, at);
    if (end == text.npos) break;
    // The last two bytes of the line tell.
    const std::size_t begin = end > 1 ? end - 2 : 0;
    if (!goes_on(text.substr(begin, end - begin))) return end + 1;
    at = end + 1;
  }
  return text.size();
}

std::string_view Lines::physical() {
  const auto* const found =
      static_cast<const char*>(std::memchr(at_, line_end_, static_cast<std::size_t>(end_ - at_)));
  const char* const end = found != nullptr ? found : end_;
  const std::string_view line(at_, static_cast<std::size_t>(end - at_));
  at_ = found != nullptr ? end + 1 : end;
  ++count_;
  return line;
}

bool Lines::next(std::string_view& line) {
  if (at_ == end_) return false;
  number_ = count_;
  line = physical();
  if (!goes_on(line) || is_comment(line)) return true;
  joined_.clear();
  while (goes_on(line)) {
    joined_ += line.substr(0, line.rfind('\\'));
    joined_ += ' ';
    line = at_ != end_ ? physical() : std::string_view();
  }
  joined_ += line;
  line = joined_;
  return true;
}

}  // namespace metamer::obj
