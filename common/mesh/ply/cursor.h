#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
#include <vector>

#include "common/mesh/ply/header.h"
#include "common/mesh/text.h"

/// Places in the body of a PLY. Each reads the value that is there and moves past it; nothing: the
/// bytes end, or the text is no number. Copies are independent.
namespace metamer::ply {

/// A value as a binary file has it.
template <typename T, bool swap>
T load(const char* at) {
  std::array<char, sizeof(T)> bytes;
  for (std::size_t i = 0; i < sizeof(T); ++i) bytes[i] = at[swap ? sizeof(T) - 1 - i : i];
  return std::bit_cast<T>(bytes);
}

/// Calls `with` for a type with a value of it.
template <typename With>
[[gnu::always_inline]] inline auto for_type(Scalar type, const With& with) {
  switch (type) {
    case Scalar::i8:
      return with(std::int8_t{});
    case Scalar::u8:
      return with(std::uint8_t{});
    case Scalar::i16:
      return with(std::int16_t{});
    case Scalar::u16:
      return with(std::uint16_t{});
    case Scalar::i32:
      return with(std::int32_t{});
    case Scalar::u32:
      return with(std::uint32_t{});
    case Scalar::f32:
      return with(float{});
    case Scalar::f64:
      break;
  }
  return with(double{});
}

/// A number as a whole one; nothing: it has a fraction, or is out of the range of any index.
template <typename T>
std::optional<std::int64_t> whole(T value) {
  if constexpr (std::is_floating_point_v<T>)
    if (!(value >= -1 && value <= T(1e15)) || std::trunc(value) != value) return std::nullopt;
  return static_cast<std::int64_t>(value);
}

// The readers of single values are inline: a call takes three times as long as what it does.
template <bool swap>
class BinaryCursor {
 public:
  explicit BinaryCursor(std::string_view bytes) : at_(bytes.data()), end_(at_ + bytes.size()) {}

  const char* place() const { return at_; }
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

  [[gnu::always_inline]] std::optional<double> read_number(Scalar type) {
    const char* const from = at_;
    if (!skip(type, 1)) return std::nullopt;
    return for_type(type, [&](auto value) -> double { return load<decltype(value), swap>(from); });
  }
  [[gnu::always_inline]] std::optional<std::int64_t> read_integer(Scalar type) {
    const char* const from = at_;
    if (!skip(type, 1)) return std::nullopt;
    return for_type(type, [&](auto value) { return whole(load<decltype(value), swap>(from)); });
  }
  /// So many whole numbers; false: one is none, or the bytes end.
  bool read_integers(Scalar type, std::size_t count, std::vector<std::int64_t>& to) {
    const char* const from = at_;
    if (!skip(type, count)) return false;
    to.resize(count);
    return for_type(type, [&](auto of_type) {
      using T = decltype(of_type);
      for (std::size_t i = 0; i < count; ++i) {
        const auto value = whole(load<T, swap>(from + i * sizeof(T)));
        if (!value) return false;
        to[i] = *value;
      }
      return true;
    });
  }
  /// Past so many values; false: there are not so many.
  bool skip(Scalar type, std::uint64_t count) {
    const std::size_t size = size_of(type);
    if (count > left() || count * size > left())
      return false;  // A division takes longer than all else.
    at_ += count * size;
    return true;
  }

 private:
  const char *at_, *end_;
};

class TextCursor {
 public:
  explicit TextCursor(std::string_view text) : at_(text.data()), end_(at_ + text.size()) {}

  /// Of the value that comes next.
  const char* place() const { return mesh_text::skip_space(at_, end_); }
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

  std::optional<double> read_number(Scalar) {
    at_ = place();
    return mesh_text::read_number(at_, end_);
  }
  std::optional<std::int64_t> read_integer(Scalar) {
    at_ = place();
    if (const auto value = mesh_text::read_integer(at_, end_)) return value;
    const char* after = at_;  // Some write whole numbers as 3.0, too.
    const auto number = mesh_text::read_number(after, end_);
    const auto value = number ? whole(*number) : std::nullopt;
    if (value) at_ = after;
    return value;
  }
  bool read_integers(Scalar type, std::size_t count, std::vector<std::int64_t>& to) {
    to.clear();
    for (std::size_t i = 0; i < count; ++i) {
      const auto value = read_integer(type);
      if (!value) return false;
      to.push_back(*value);
    }
    return true;
  }
  bool skip(Scalar, std::uint64_t count) {
    for (; count > 0; --count) {
      const char* const begin = place();
      if (begin == end_) return false;
      at_ = mesh_text::skip_word(begin, end_);
    }
    return true;
  }

 private:
  const char *at_, *end_;
};

}  // namespace metamer::ply
