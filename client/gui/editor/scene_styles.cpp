#include "client/gui/editor/scene_styles.h"

#include <algorithm>
#include <cstddef>

namespace metamer::gui {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

std::size_t end_of_quotes(std::string_view text, std::size_t at) {
  const char quote = text[at++];
  while (at < text.size() && text[at] != quote && text[at] != '\n')
    at += text[at] == '\\' && at + 1 < text.size() && text[at + 1] != '\n' ? 2 : 1;
  return at;
}

std::size_t end_of_number(std::string_view text, std::size_t at) {
  for (++at; at < text.size(); ++at) {
    const char c = text[at];
    const bool sign = (c == '-' || c == '+') && (text[at - 1] == 'e' || text[at - 1] == 'E');
    if (!is_digit(c) && !is_letter(c) && c != '.' && !sign) break;
  }
  return at;
}

bool starts_number(std::string_view text, std::size_t at) {
  if (is_digit(text[at])) return true;
  return text[at] == '.' && at + 1 < text.size() && is_digit(text[at + 1]);
}

}  // namespace

std::string scene_styles(std::string_view lines) {
  std::string styles(lines.size(), static_cast<char>(SceneStyle::plain));
  char before = '\n';  // The last byte on the line that is no blank.
  for (std::size_t at = 0; at < lines.size();) {
    const char c = lines[at];
    std::size_t end = at + 1;
    SceneStyle style = SceneStyle::plain;
    if (c == '#') {
      end = std::min(lines.find('\n', at), lines.size());
      style = SceneStyle::comment;
    } else if (c == '"' || c == '\'') {
      end = end_of_quotes(lines, at);
      const bool closed = end < lines.size() && lines[end] == c;
      style = closed ? SceneStyle::text : SceneStyle::open_text;
      end += closed ? 1 : 0;
    } else if (starts_number(lines, at)) {
      end = end_of_number(lines, at);
      style = SceneStyle::number;
    } else if (is_letter(c)) {
      while (end < lines.size() && (is_letter(lines[end]) || is_digit(lines[end]))) ++end;
      const bool value = before == ':' || before == ',' || before == '[' || before == '-';
      style = value ? SceneStyle::word : SceneStyle::field;
    } else if (std::string_view("{}<>[]").find(c) != std::string_view::npos) {
      style = SceneStyle::brace;
    } else if (c == '-') {
      style = SceneStyle::number;
    }
    if (style != SceneStyle::plain)
      std::fill(styles.begin() + static_cast<std::ptrdiff_t>(at),
                styles.begin() + static_cast<std::ptrdiff_t>(end), static_cast<char>(style));
    if (c == '\n')
      before = '\n';
    else if (c != ' ' && c != '\t' && c != '\r')
      before = lines[end - 1];
    at = end;
  }
  return styles;
}

int depth_after(std::string_view line, std::string_view styles, int depth) {
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (styles[i] != static_cast<char>(SceneStyle::brace)) continue;
    const bool opens = line[i] == '{' || line[i] == '<' || line[i] == '[';
    depth = std::max(0, depth + (opens ? 1 : -1));
  }
  return depth;
}

}  // namespace metamer::gui
