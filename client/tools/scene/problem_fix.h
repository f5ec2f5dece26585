#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "common/problem.h"

namespace metamer::client {

/// Something else in the place of the bytes begin to end of a text.
struct TextEdit {
  std::size_t begin = 0, end = 0;
  std::string text;
};

/// What mends a located problem in the scene's text that it was found in, or in what that has
/// become since: `by` in the place of `was`, which is looked for as a value or a name at the
/// problem's place. In quotes it stays in quotes. Nothing: it does not stand there any more.
std::optional<TextEdit> replacement(std::string_view text, const Problem& problem,
                                    std::string_view by);

/// The same by what the problem itself offers (`meant`).
std::optional<TextEdit> problem_fix(std::string_view text, const Problem& problem);

}  // namespace metamer::client
