#include "common/mesh/ply/header.h"

#include <algorithm>
#include <array>
#include <utility>

#include "common/mesh/text.h"

namespace metamer::ply {
namespace {

using mesh_text::cited;

constexpr std::size_t most_header = std::size_t{1} << 20;

struct TypeName {
  std::string_view name;
  Scalar type;
};
constexpr TypeName type_names[] = {
    {"char", Scalar::i8},     {"int8", Scalar::i8},     {"uchar", Scalar::u8},
    {"uint8", Scalar::u8},    {"short", Scalar::i16},   {"int16", Scalar::i16},
    {"ushort", Scalar::u16},  {"uint16", Scalar::u16},  {"int", Scalar::i32},
    {"int32", Scalar::i32},   {"uint", Scalar::u32},    {"uint32", Scalar::u32},
    {"float", Scalar::f32},   {"float32", Scalar::f32}, {"double", Scalar::f64},
    {"float64", Scalar::f64},
};

std::optional<Scalar> type_named(std::string_view name) {
  for (const TypeName& known : type_names)
    if (known.name == name) return known.type;
  return std::nullopt;
}

std::vector<std::string_view> words_of(std::string_view line) {
  std::vector<std::string_view> words;
  const char* at = line.data();
  const char* const end = at + line.size();
  while ((at = mesh_text::skip_space(at, end)) != end) {
    const char* const begin = std::exchange(at, mesh_text::skip_word(at, end));
    words.emplace_back(begin, static_cast<std::size_t>(at - begin));
  }
  return words;
}

/// The lines of a header, whose first one tells how they end. (A binary file's first value may look
/// like a part of the last one's end.)
class Lines {
 public:
  explicit Lines(std::string_view bytes) : bytes_(bytes.substr(0, most_header)) {
    const std::size_t end = bytes_.find_first_of("\r\n");
    if (end == std::string_view::npos) return;
    if (bytes_[end] == '\n' || bytes_.substr(end, 2) == "\r\n") end_ = '\n';
  }
  std::optional<std::string_view> next() {
    const std::size_t end = bytes_.find(end_, size_);
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view line = bytes_.substr(size_, end - size_);
    size_ = end + 1;
    ++number_;
    return line;
  }
  int number() const { return number_; }
  std::size_t size() const { return size_; }

 private:
  std::string_view bytes_;
  char end_ = '\r';  ///< A CR before LF is a blank.
  std::size_t size_ = 0;
  int number_ = 0;
};

using Words = std::vector<std::string_view>;

/// What is wrong with a line, without its place.
using Wrong = std::optional<std::string>;

Wrong read_format(const Words& words, std::optional<Format>& format) {
  if (words.size() < 2) return "format has no name";
  if (words[1] == "ascii")
    format = Format::ascii;
  else if (words[1] == "binary_little_endian")
    format = Format::little_endian;
  else if (words[1] == "binary_big_endian")
    format = Format::big_endian;
  else
    return "format " + cited(words[1]) +
           " is neither ascii, binary_little_endian nor binary_big_endian";
  return std::nullopt;
}

Wrong read_element(const Words& words, std::vector<Element>& elements) {
  if (words.size() != 3) return "an element has a name and a count";
  const char* at = words[2].data();
  const auto count = mesh_text::read_integer(at, at + words[2].size());
  if (!count || *count < 0)
    return "element count " + cited(words[2]) + " is no whole number from 0";
  elements.push_back({.name = std::string(words[1]),
                      .count = static_cast<std::uint64_t>(*count),
                      .properties = {}});
  return std::nullopt;
}

Wrong read_property(const Words& words, std::vector<Element>& elements) {
  if (elements.empty()) return "a property stands before any element";
  const bool list = words.size() >= 2 && words[1] == "list";
  if (words.size() != (list ? 5 : 3)) return "a property has a type and a name";
  Property property{.name = std::string(words.back()), .type = {}, .count = std::nullopt};
  const std::string_view type = words[words.size() - 2];
  if (const auto known = type_named(type))
    property.type = *known;
  else
    return "type " + cited(type) + " is none of PLY's";
  if (list) {
    property.count = type_named(words[2]);
    if (!property.count || *property.count == Scalar::f32 || *property.count == Scalar::f64)
      return "a list is counted by a whole number, not by " + cited(words[2]);
  }
  elements.back().properties.push_back(std::move(property));
  return std::nullopt;
}

}  // namespace

std::size_t Element::least_size(Format format) const {
  std::size_t size = 0;
  for (const Property& property : properties)  // In text a digit, and a blank before the next.
    size += format == Format::ascii ? 2 : size_of(property.count.value_or(property.type));
  return size;
}

bool Element::has_lists() const {
  return std::any_of(properties.begin(), properties.end(),
                     [](const Property& property) { return property.count.has_value(); });
}

std::optional<std::size_t> Element::find(std::initializer_list<std::string_view> names) const {
  const auto found = std::find_first_of(
      properties.begin(), properties.end(), names.begin(), names.end(),
      [](const Property& property, std::string_view name) { return property.name == name; });
  if (found == properties.end()) return std::nullopt;
  return static_cast<std::size_t>(found - properties.begin());
}

Result<Header> read_header(std::string_view bytes, const std::string& file) {
  Lines lines(bytes);
  const auto first = lines.next();
  if (!first || words_of(*first) != Words{"ply"})
    return mesh_text::problem_at(file, 1, "a PLY begins with the line \"ply\"");
  std::optional<Format> format;
  Header header{};
  while (const auto line = lines.next()) {
    const Words words = words_of(*line);
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    Wrong wrong;
    if (words[0] == "format")
      wrong = read_format(words, format);
    else if (words[0] == "element")
      wrong = read_element(words, header.elements);
    else if (words[0] == "property")
      wrong = read_property(words, header.elements);
    else if (words[0] == "end_header" && !format)
      wrong = "the header names no format";
    else if (words[0] == "end_header") {
      header.format = *format;
      header.size = lines.size();
      return header;
    } else
      wrong = "word " + cited(words[0]) + " is none of a PLY's header";
    if (wrong) return mesh_text::problem_at(file, lines.number(), *std::move(wrong));
  }
  return mesh_text::problem_at(file, lines.number(), "the header has no end_header");
}

}  // namespace metamer::ply
