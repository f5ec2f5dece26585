#include "common/picture_head.h"

#include <algorithm>

namespace metamer {
namespace {

using Size = std::uint64_t;
using namespace std::string_view_literals;
constexpr std::string_view png = "\x89PNG\r\n\x1a\n"sv, exr = "\x76\x2f\x31\x01"sv;
constexpr Size most_of_png = Size{256} << 20, most_of_exr = Size{64} << 20;
constexpr Size most_channels = 32;
constexpr Size longest_side = Size{1} << 31;
/// Deflate makes at most 1032 bytes of one (zlib's technical notes), each at most eight pixels.
constexpr Size most_pixels_of_byte = 8 * 1032;

/// Of sides of `longest_side` at most.
Size product(Size width, Size height, Size channels, Size most) {
  const Size pixels = width * height;
  return channels > 0 && pixels > most / channels ? most : pixels * channels;
}

/// A file's first bytes, taken one after the other; past their end all is 0.
class Head {
 public:
  explicit Head(std::string_view bytes) : left_(bytes) {}

  bool ended() const { return ended_; }
  std::string_view take(Size count) {
    ended_ |= count > left_.size();
    const std::string_view taken = left_.substr(0, ended_ ? 0 : count);
    left_.remove_prefix(taken.size());
    return taken;
  }
  std::string_view text() {
    const std::size_t length = left_.find('\0');
    if (length == std::string_view::npos) return take(left_.size() + 1);
    const std::string_view taken = take(length);
    take(1);
    return taken;
  }
  Size big_endian() {
    Size number = 0;
    for (const char byte : take(4)) number = number << 8 | static_cast<unsigned char>(byte);
    return number;
  }
  Size little_endian() {
    const std::string_view bytes = take(4);
    Size number = 0;
    for (std::size_t i = bytes.size(); i-- > 0;)
      number = number << 8 | static_cast<unsigned char>(bytes[i]);
    return number;
  }

 private:
  std::string_view left_;
  bool ended_ = false;
};

Size values_of_png(Head head, Size file_bytes) {
  head.take(8);
  if (head.big_endian() != 13 || head.take(4) != "IHDR") return 0;
  const Size width = head.big_endian(), height = head.big_endian();
  if (head.take(2).size() != 2 || width > longest_side || height > longest_side) return 0;
  // Grey becomes three values where it is a colour, a palette four where it has transparent ones.
  const Size values = product(width, height, 4, most_of_png);
  return std::min(values, product(file_bytes, most_pixels_of_byte, 4, most_of_png));
}

/// Of a chlist: a name, and 16 bytes.
Size channels_in(std::string_view list) {
  Head head(list);
  Size count = 0;
  while (!head.text().empty() && head.take(16).size() == 16) ++count;
  return count;
}

/// Of a box2i.
Size pixels_in(std::string_view window) {
  Head head(window);
  const auto next = [&] { return static_cast<std::int32_t>(head.little_endian()); };
  const std::int64_t x0 = next(), y0 = next(), x1 = next(), y1 = next();
  if (head.ended() || x1 < x0 || y1 < y0) return 0;
  const auto side = [](std::int64_t from, std::int64_t to) {
    return std::min(static_cast<Size>(to - from + 1), longest_side);
  };
  return side(x0, x1) * side(y0, y1);
}

/// Of the part that has most.
Size values_of_exr(Head head) {
  head.take(4);
  constexpr Size several_parts = 0x1000;
  const bool several = (head.little_endian() & several_parts) != 0;
  Size most = 0;
  while (!head.ended()) {
    Size channels = 0, pixels = 0, attributes = 0;
    for (std::string_view name = head.text(); !name.empty(); name = head.text(), ++attributes) {
      head.text();  // its type
      const std::string_view value = head.take(head.little_endian());
      if (name == "channels") channels = std::min(channels_in(value), most_channels);
      if (name == "dataWindow" || name == "displayWindow")
        pixels = std::max(pixels, pixels_in(value));
    }
    most = std::max(most, product(pixels, 1, channels, most_of_exr));
    if (!several || attributes == 0) break;
  }
  return most;
}

}  // namespace

bool begins_picture(std::string_view head) {
  return head.starts_with(png) || head.starts_with(exr);
}

std::uint64_t picture_values(std::string_view head, std::uint64_t file_bytes) {
  if (head.starts_with(png)) return values_of_png(Head(head), file_bytes);
  return head.starts_with(exr) ? values_of_exr(Head(head)) : 0;
}

}  // namespace metamer
