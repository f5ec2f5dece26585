#pragma once

#include <string>
#include <string_view>

#include "common/problem.h"

namespace metamer {

/// The text of a file in UTF-8, with lines that end in "\n": from UTF-8 and UTF-16 with or without
/// the mark of their byte order, and Latin-1 (ISO 8859-1) where the bytes are neither. Lines may
/// end in CR, LF or both. A no-break or thin space becomes a blank. Errors: UTF-16 with half a
/// character; NUL, which no text has.
Result<std::string> utf8_text(std::string_view bytes, const std::string& file);

}  // namespace metamer
