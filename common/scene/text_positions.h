#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace metamer {

/// A position in a text as protobuf's tokenizer counts: lines and columns from 0, a tab goes on to
/// the next multiple of 8.
struct TextPosition {
  int line = 0;
  int column = 0;

  auto operator<=>(const TextPosition&) const = default;
};

/// Lines and columns for people: both from 1, columns in bytes, a tab is one. Keeps no text.
class TextLines {
 public:
  explicit TextLines(std::string_view text);

  /// The column of `position` in `text`, the text that this was made from.
  int column(std::string_view text, TextPosition position) const;
  /// Where its line begins: the byte's index.
  std::size_t begin(TextPosition position) const {
    return begins_[static_cast<std::size_t>(position.line)];
  }

 private:
  std::vector<std::size_t> begins_;  ///< Where each line begins.
};

/// Where the last identifier `name` before `end` stands: protobuf reports an unknown name at the
/// token after it.
std::optional<TextPosition> last_identifier(std::string_view text, std::string_view name,
                                            TextPosition end);

/// The number that stands at column `column`, from 1, of the line that begins at `begin`, or behind
/// the name and the colon there, as it is written; empty: none does.
std::string_view number_at(std::string_view text, std::size_t begin, std::size_t column);

/// The lists `name: [a, b]` of a text. protobuf keeps only the position of the name.
struct TextLists {
  /// By the position of the list's name.
  std::map<TextPosition, std::vector<TextPosition>> elements;
  std::set<std::string, std::less<>> names;  ///< Fields that are written so somewhere.
};
TextLists find_lists(std::string_view text);

}  // namespace metamer
