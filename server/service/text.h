#pragma once

#include <string>
#include <string_view>

namespace metamer::service {

/// At most `most` bytes of UTF-8, cut before a character that would not fit.
inline std::string shortened(std::string_view text, std::size_t most) {
  if (text.size() <= most) return std::string(text);
  while (most > 0 && (static_cast<unsigned char>(text[most]) & 0xC0) == 0x80) --most;
  return std::string(text.substr(0, most));
}

/// A client's text for the log: short, and without characters that would forge lines there.
inline std::string for_log(std::string_view text) {
  std::string shown = shortened(text, 100);
  for (char& c : shown) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = '?';
  }
  return shown;
}

}  // namespace metamer::service
