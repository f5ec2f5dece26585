#pragma once

#include <array>
#include <cstdio>
#include <string>

namespace metamer::client {

/// A line of text as printf makes it, of at most 400 bytes.
template <class... Values>
std::string formatted(const char* format, Values... values) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

}  // namespace metamer::client
