#pragma once

#include <string>
#include <string_view>

namespace metamer::obj {

/// What ends the lines of a file: LF, before which a CR is a blank, or CR alone.
char line_end(std::string_view text);

/// Where a piece of the text may end at or after `at`: behind a line that does not go on in the
/// next one.
std::size_t piece_end(std::string_view text, std::size_t at, char line_end);

/// The lines of a piece of an OBJ. One that ends in `\` goes on in the next; comments do not.
class Lines {
 public:
  Lines(std::string_view piece, char line_end)
      : at_(piece.data()), end_(at_ + piece.size()), line_end_(line_end) {}

  /// The next line without its end; false: there is none. Valid until the next call.
  bool next(std::string_view& line);
  /// Of the line that next() gave, from 0.
  int number() const { return number_; }
  /// How many there have been.
  int count() const { return count_; }

 private:
  std::string_view physical();

  const char *at_, *end_;
  char line_end_;
  int number_ = 0, count_ = 0;
  std::string joined_;
};

}  // namespace metamer::obj
