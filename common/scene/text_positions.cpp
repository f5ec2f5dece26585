#include "common/scene/text_positions.h"

#include <algorithm>
#include <cassert>

#include "common/scene/text_tokens.h"

namespace metamer {

TextLines::TextLines(std::string_view text) : begins_{0} {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') begins_.push_back(i + 1);
  }
}

int TextLines::column(std::string_view text, TextPosition position) const {
  constexpr int tab_width = 8;
  const auto line = static_cast<std::size_t>(position.line);
  assert(line < begins_.size());
  const std::size_t begin = begins_[line];
  std::size_t at = begin;
  for (int column = 0; column < position.column && at < text.size() && text[at] != '\n'; ++at) {
    column += text[at] == '\t' ? tab_width - column % tab_width : 1;
  }
  return static_cast<int>(at - begin) + 1;
}

std::optional<TextPosition> last_identifier(std::string_view text, std::string_view name,
                                            TextPosition end) {
  std::optional<TextPosition> found;
  TextTokens tokens(text);
  while (tokens.next() && tokens.position() < end) {
    if (tokens.is_identifier() && tokens.text() == name) found = tokens.position();
  }
  return found;
}

std::string_view number_at(std::string_view text, std::size_t begin, std::size_t column) {
  constexpr std::string_view blank = " \t\r\n";
  constexpr std::string_view name =
      "_0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  constexpr std::string_view number = "+-.0123456789eE";
  const auto skip = [&](std::string_view characters) {
    text.remove_prefix(std::min(text.find_first_not_of(characters), text.size()));
  };
  text.remove_prefix(std::min(begin + column - 1, text.size()));
  if (!text.empty() && number.substr(0, 13).find(text[0]) == std::string_view::npos) {
    skip(name);
    skip(blank);
    if (!text.starts_with(':')) return {};
    text.remove_prefix(1);
    skip(blank);
  }
  return text.substr(0, std::min(text.find_first_not_of(number), text.size()));
}

TextLists find_lists(std::string_view text) {
  TextLists lists;
  struct Open {
    bool list;
    TextPosition name;
  };
  std::vector<Open> open;
  std::string name;
  TextPosition name_position;
  bool element_starts = false;

  TextTokens tokens(text);
  while (tokens.next()) {
    // A token after "[" or "," of a list is where an element begins.
    if (element_starts && !tokens.is("]")) {
      lists.elements[open.back().name].push_back(tokens.position());
    }
    element_starts = false;

    if (tokens.is_identifier()) {
      name = tokens.text();
      name_position = tokens.position();
    } else if (tokens.is("[")) {
      open.push_back({true, name_position});
      lists.elements[name_position];
      lists.names.insert(name);
      element_starts = true;
    } else if (tokens.is("{") || tokens.is("<")) {
      open.push_back({false, {}});
    } else if (tokens.is("]") || tokens.is("}") || tokens.is(">")) {
      if (!open.empty()) open.pop_back();
    } else if (tokens.is(",") && !open.empty() && open.back().list) {
      element_starts = true;
    }
  }
  return lists;
}

}  // namespace metamer
