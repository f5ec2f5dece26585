#include "common/image/exr_header.h"

#include <array>
#include <cstdint>
#include <map>
#include <string>

#include "common/image/picture_file.h"

namespace metamer {
namespace {

constexpr std::size_t longest_name = 255;

/// Bytes of the types that have always as many.
const std::map<std::string, std::int64_t>& fixed_sizes() {
  static const std::map<std::string, std::int64_t> sizes = {
      {"box2f", 16},         {"box2i", 16},    {"chromaticities", 32},
      {"compression", 1},    {"double", 8},    {"envmap", 1},
      {"deepImageState", 1}, {"float", 4},     {"int", 4},
      {"keycode", 28},       {"lineOrder", 1}, {"m33f", 36},
      {"m33d", 72},          {"m44f", 64},     {"m44d", 128},
      {"rational", 8},       {"v2f", 8},       {"tiledesc", 9},
      {"timecode", 8},       {"v2i", 8},       {"v2d", 16},
      {"v3f", 12},           {"v3i", 12},      {"v3d", 24}};
  return sizes;
}

std::string text_of(std::istream& in) {
  std::string text;
  for (char c = 0; text.size() <= longest_name && in.get(c) && c != 0;) text += c;
  if (text.size() > longest_name) in.setstate(std::ios::failbit);
  return text;
}

std::int64_t number_of(std::istream& in) {
  std::array<char, 4> bytes{};
  in.read(bytes.data(), bytes.size());
  std::uint32_t number = 0;
  for (std::size_t i = 4; i-- > 0;) number = number << 8 | static_cast<unsigned char>(bytes[i]);
  return number;
}

/// Whether a list of channels, which an empty name ends, ends where its attribute does.
bool channels_end_at(std::istream& in, std::int64_t end) {
  while (!text_of(in).empty()) in.ignore(16);
  return in && in.tellg() == end;
}

/// What is wrong with the attribute that `in` has come to, but for its name; empty: nothing.
std::string attribute_fault(std::istream& in, std::int64_t file_size) {
  const std::string type = text_of(in);
  const std::int64_t size = number_of(in), from = in.tellg();
  if (!in) return "is cut short";
  if (size > file_size - from) return "claims more bytes than the file has";
  const auto fixed = fixed_sizes().find(type);
  const bool right = (fixed == fixed_sizes().end() || size == fixed->second) &&
                     (type != "floatvector" || size % 4 == 0) &&
                     (type != "chlist" || channels_end_at(in, from + size));
  in.clear();
  in.seekg(from + size);
  return right ? std::string() : "has not the size of a " + type;
}

}  // namespace

Result<void> check_exr_header(std::istream& in, const std::filesystem::path& name) {
  in.seekg(0, std::ios::end);
  const std::int64_t size = in.tellg();
  in.seekg(4);  // the magic number
  constexpr std::int64_t several_parts = 0x1000;
  const bool several = (number_of(in) & several_parts) != 0;
  for (bool is_first = true; in; is_first = false) {
    const std::string attribute = text_of(in);
    if (attribute.empty() && (!several || is_first)) break;
    if (attribute.empty()) {
      // Another part's header follows, or the end of all.
      if (in.peek() == 0) break;
      continue;
    }
    if (const std::string fault = attribute_fault(in, size); !fault.empty())
      return file_problem(name,
                          "can't read the picture: attribute " + quoted(attribute) + " " + fault);
  }
  return {};
}

}  // namespace metamer
