#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace metamer {

/// The encodings that texts of users come in, as iconv(3) names them.
inline constexpr const char* text_encodings[] = {"UTF-8", "ISO-8859-1", "UTF-16LE", "UTF-16BE"};

/// `bytes` of one of these in UTF-8, by the C library's iconv; nothing where they are not of it.
std::optional<std::string> to_utf8(std::string_view bytes, const char* encoding);

/// Loads what to_utf8() takes from the system's files, for a process that is about to be shut off
/// from them.
void load_encodings();

}  // namespace metamer
