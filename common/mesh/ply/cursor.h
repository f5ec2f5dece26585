#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

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
auto for_type(Scalar type, const With& with) {
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

template <bool swap>
class BinaryCursor {
 public:
  explicit BinaryCursor(std::string_view bytes) : at_(bytes.data()), end_(at_ + bytes.size()) {}

  const char* place() const { return at_; }
  std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

  std::optional<double> read_number(Scalar type) { return read<double>(type); }
  std::optional<std::int64_t> read_integer(Scalar type) {
    if (type != Scalar::f32 && type != Scalar::f64) return read<std::int64_t>(type);
    const auto value = read<double>(type);
    if (!value || !(*value >= -1 && *value <= 1e15)) return std::nullopt;
    const auto whole = static_cast<std::int64_t>(*value);
    if (static_cast<double>(whole) != *value) return std::nullopt;
    return whole;
  }
  /// Past so many values; false: there are not so many.
  bool skip(Scalar type, std::uint64_t count) {
    if (count > left() / size_of(type)) return false;
    at_ += count * size_of(type);
    return true;
  }

 private:
  template <typename To>
  std::optional<To> read(Scalar type) {
    if (size_of(type) > left()) return std::nullopt;
    const char* const from = at_;
    at_ += size_of(type);
    return for_type(type,
                    [&](auto value) { return static_cast<To>(load<decltype(value), swap>(from)); });
  }

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
  /// Some write whole numbers as 3.0, too.
  std::optional<std::int64_t> read_integer(Scalar) {
    at_ = place();
    if (const auto value = mesh_text::read_integer(at_, end_)) return value;
    const char* after = at_;
    const auto value = mesh_text::read_number(after, end_);
    if (!value || !(*value >= -1 && *value <= 1e15)) return std::nullopt;
    const auto whole = static_cast<std::int64_t>(*value);
    if (static_cast<double>(whole) != *value) return std::nullopt;
    at_ = after;
    return whole;
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
