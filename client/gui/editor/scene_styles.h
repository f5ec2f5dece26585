#pragma once

#include <string>
#include <string_view>

namespace metamer::gui {

/// What a byte of a scene's text belongs to.
enum class SceneStyle : char { plain, field, text, open_text, number, comment, word, brace };
inline constexpr int scene_style_count = 8;

/// The style of each byte of lines of a scene's text, from the beginning of a line. A line's styles
/// do not depend on other lines: a name is a value where ":", "," or "[" stands before it on its
/// line, else a field. Takes time by the length.
std::string scene_styles(std::string_view lines);

/// How many braces more are opened than closed in a line with these styles: depth after it, 0 or
/// more, where it is `depth` before it.
int depth_after(std::string_view line, std::string_view styles, int depth);

}  // namespace metamer::gui
