#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <vector>

namespace metamer {

/// One thing wrong with somebody's input, and where. A value, never an exception.
struct Problem {
  std::string field;    ///< Path in the scene, "object[2].mesh.file"; empty: not known.
  std::string file;     ///< The file it stands in, as the user named it; empty: not known.
  int line = 0;         ///< In `file`, from 1; 0: not known.
  int column = 0;       ///< In `file`, from 1; 0: not known.
  std::string message;  ///< One sentence, no capital, no full stop: "radius must be above 0".
  /// What stands there, as it is written but without quotes, and what can be put in its place: the
  /// near match or the nearest value that is allowed. Empty: nothing can; `was` alone: a file that
  /// does not exist.
  std::string was{};
  std::string meant{};
};

/// A value, or what is wrong with the input that it should have come from.
template <class T>
using Result = tl::expected<T, Problem>;

/// A problem that has only a message so far; the caller that knows the place adds it.
inline tl::unexpected<Problem> problem(std::string message) {
  return tl::unexpected<Problem>({.field = {}, .file = {}, .message = std::move(message)});
}

/// How a person reads it, as compilers write it: `file:line:column: error: message`, then, where
/// `source` (the text of `file`) has that line, the line itself and a caret under the column (which
/// counts bytes). A problem without a line names its field: `error: light[0].name: message`.
/// Ends without a line break. Long source lines are cut around the caret; control characters, which
/// could command a terminal, come out as `?`.
std::string format(const Problem& problem, std::string_view source = {});

/// The one of `known` that is closest to `name`; empty where none is close (edit distance at most a
/// third of its length, at least 1). The distance is Damerau–Levenshtein's (optimal string
/// alignment); upper and lower case are alike.
std::string best_match(std::string_view name, const std::vector<std::string>& known);

/// `; did you mean "tcs09"?` of the best match; an empty string where there is none.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& known);

/// A problem with a name of the input that is none of `known`: `message`, with the best match at
/// its end, which can be put in its place.
Problem unknown_name(std::string message, std::string_view name,
                     const std::vector<std::string>& known);

/// `text` in double quotes, as a message cites somebody's input: control characters come out as
/// `?`, and it is cut after 60 bytes.
std::string quoted(std::string_view text);
// Exact overloads, because <filesystem> brings a template std::quoted that fits better otherwise.
inline std::string quoted(const std::string& text) { return quoted(std::string_view(text)); }
inline std::string quoted(const char* text) { return quoted(std::string_view(text)); }

/// The shortest decimal text that reads back as `value`, for messages: "0.1", "1e+300", "nan".
std::string number_text(double value);

}  // namespace metamer
