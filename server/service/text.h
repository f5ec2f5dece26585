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

}  // namespace metamer::service
