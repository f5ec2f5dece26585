#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace metamer::fuzz {

/// The input, from its beginning to its end; beyond that zeros. A number counts from the digit 0,
/// so that seeds can be written by hand: "0", "1", … and "@", which is 16.
class Bytes {
 public:
  explicit Bytes(std::string_view input) : rest_(input) {}

  bool empty() const { return rest_.empty(); }
  char next() {
    if (rest_.empty()) return '0';
    const char first = rest_.front();
    rest_.remove_prefix(1);
    return first;
  }
  std::uint8_t number() { return static_cast<std::uint8_t>(next() - '0'); }
  /// One of 0 … count - 1.
  std::size_t pick(std::size_t count) { return count == 0 ? 0 : number() % count; }
  bool flag() { return number() % 2 == 1; }
  std::uint32_t wide() {
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value = value << 8 | static_cast<std::uint8_t>(next());
    return value;
  }
  /// The next ones, as they are.
  std::string take(std::size_t count) {
    const std::string taken(rest_.substr(0, count));
    rest_.remove_prefix(std::min(count, rest_.size()));
    return taken;
  }

 private:
  std::string_view rest_;
};

}  // namespace metamer::fuzz
