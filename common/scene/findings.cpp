#include "common/scene/findings.h"

#include <algorithm>

namespace metamer {

namespace {

/// Bytes of the UTF-8 character at the start of `text`; 0 where it is not well-formed.
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) -> unsigned {
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
  };
  const auto follows = [&](std::size_t i, unsigned low = 0x80, unsigned high = 0xBF) {
    return byte(i) >= low && byte(i) <= high;
  };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(1) ? 2 : 0;
  // Overlong forms and surrogates show in the second byte.
  if (first >= 0xE0 && first <= 0xEF) {
    const bool second = follows(1, first == 0xE0 ? 0xA0 : 0x80, first == 0xED ? 0x9F : 0xBF);
    return second && follows(2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    const bool second = follows(1, first == 0xF0 ? 0x90 : 0x80, first == 0xF4 ? 0x8F : 0xBF);
    return second && follows(2) && follows(3) ? 4 : 0;
  }
  return 0;
}

}  // namespace

void Findings::add(std::string field, std::string message) {
  problems_.push_back({.field = std::move(field), .file = {}, .message = std::move(message)});
}

void Findings::add(std::string field, Problem problem) {
  problem.field = std::move(field);
  add(std::move(problem));
}

void Findings::add(std::string field, std::string message, double value, double nearest) {
  add({.field = std::move(field),
       .file = {},
       .message = std::move(message),
       .was = number_text(value),
       .meant = number_text(nearest)});
}

std::string indexed(std::string_view field, std::size_t index) {
  return std::string(field) + "[" + std::to_string(index) + "]";
}

void check_range(double value, double low, double high, const std::string& field,
                 Findings& findings) {
  if (value >= low && value <= high) return;
  const std::string name = field.substr(field.rfind('.') + 1);
  findings.add(field,
               name + " must lie in " + number_text(low) + ".." + number_text(high) + " (it is " +
                   number_text(value) + ")",
               value, std::clamp(value, low, high));
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

}  // namespace metamer
