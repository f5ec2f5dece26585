#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "common/problem.h"

/// Numbers and words of mesh files in text.
namespace metamer::mesh_text {

inline bool is_space(char c) { return static_cast<unsigned char>(c) <= ' '; }

/// Past the blanks, tabs and line ends at `at`.
inline const char* skip_space(const char* at, const char* end) {
  while (at != end && is_space(*at)) ++at;
  return at;
}
/// Past the word at `at`.
inline const char* skip_word(const char* at, const char* end) {
  while (at != end && !is_space(*at)) ++at;
  return at;
}

/// The number at `at`, which moves past it to blank or `end`; nothing: there is none, and `at`
/// stays. Beyond f64 it is infinite; "nan" and what Microsoft's library wrote for it ("-1.#IND")
/// are NaN.
std::optional<double> read_number(const char*& at, const char* end);
/// The same for a whole number: 2, -1, +3.
std::optional<std::int64_t> read_integer(const char*& at, const char* end);

/// A name in UTF-8: bytes that are not become what they are in Latin-1.
std::string utf8_name(std::string_view bytes);

/// What a file says, in quotes, for a message.
inline std::string cited(std::string_view bytes) { return quoted(utf8_name(bytes.substr(0, 200))); }

/// A problem on a line of a file, from 1; 0: it has no lines.
tl::unexpected<Problem> problem_at(const std::string& file, int line, std::string message);

/// The line that a place is on, from 1. Lines end in LF, CR or both.
int line_of(std::string_view text, std::size_t place);

}  // namespace metamer::mesh_text
