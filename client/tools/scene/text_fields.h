#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace metamer::client {

/// Bytes of a text, from begin to before end.
struct TextSpan {
  std::size_t begin = 0, end = 0;
};

/// A field as a message in protobuf's text format has it.
struct TextField {
  std::string name;
  TextSpan span;                 ///< From its name to the end of its value, or of its list.
  std::size_t next = 0;          ///< Behind the "," or ";" that follows, where one does.
  std::vector<TextSpan> values;  ///< One, or those of the list; a message's with its braces.
};

/// The fields of the message whose inside, without braces, `text` is: a text that parses, of less
/// than 2 GiB. TextFormat::ParseInfoTree has no ranges for the elements of a list. Takes time by
/// the text's length.
std::vector<TextField> text_fields(std::string_view text);

}  // namespace metamer::client
