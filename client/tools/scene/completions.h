#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace metamer::client {

/// What can be put in the place of the bytes begin to end of a scene's text.
struct Completions {
  std::size_t begin = 0, end = 0;
  std::vector<std::string> words;  ///< As they are to stand there; empty: nothing can be listed.
};

/// Of byte `at` of a scene's text, which may be unfinished or wrong: names of fields with what
/// follows them ("luminance: ", "spectrum { "), values of enumerations, and in quotes the names
/// that the scene gives to materials and lights, those of illuminants, media and metals, and the
/// files of `folder`, which is read. At most max_completions.
Completions completions(std::string_view text, std::size_t at, const std::filesystem::path& folder);

inline constexpr std::size_t max_completions = 2000;

/// The names that a scene's text gives to its parts of a kind: "light", "material", "object".
std::vector<std::string> names_in_text(std::string_view text, std::string_view kind);

}  // namespace metamer::client
