#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/problem.h"

/// PLY (Turk, "The PLY Polygon File Format", 1994).
namespace metamer::ply {

enum class Scalar { i8, u8, i16, u16, i32, u32, f32, f64 };
enum class Format { ascii, little_endian, big_endian };

inline constexpr std::size_t scalar_sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
/// Bytes of a value in a binary file.
constexpr std::size_t size_of(Scalar type) { return scalar_sizes[static_cast<std::size_t>(type)]; }

struct Property {
  std::string name;
  Scalar type;
  std::optional<Scalar> count;  ///< Of a list: what its length is written as.
};

struct Element {
  std::string name;
  std::uint64_t count;
  std::vector<Property> properties;

  /// Bytes that each of them takes at least. 0: it has no properties.
  std::size_t least_size(Format format) const;
  bool has_lists() const;
  /// The first property of one of these names, or nothing.
  std::optional<std::size_t> find(std::initializer_list<std::string_view> names) const;
};

struct Header {
  Format format;
  std::vector<Element> elements;
  std::size_t size;  ///< Bytes to the first value.
};

/// The header, whose lines end in LF, CR or both. Errors, by line: another format, a word that is
/// none of PLY's, no end within 1 MiB.
Result<Header> read_header(std::string_view bytes, const std::string& file);

}  // namespace metamer::ply
