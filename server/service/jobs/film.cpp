#include "server/service/jobs/film.h"

#include <bit>
#include <cassert>
#include <cstring>

namespace metamer::service {

static_assert(std::endian::native == std::endian::little, "Tile.xyz is little-endian");

// calloc, and not a vector, which would write zeros over 3 GiB before the first tile.
Film::Film(std::uint32_t width, std::uint32_t height)
    : width_(width),
      height_(height),
      pixels_(static_cast<float*>(std::calloc(std::size_t{width} * height, pixel_bytes))) {}

std::string Film::copy(const Rect& rect) const {
  std::string bytes;
  bytes.reserve(std::size_t{rect.width} * rect.height * pixel_bytes);
  for (std::uint32_t row = 0; row < rect.height; ++row) {
    bytes.append(reinterpret_cast<const char*>(at(rect.x, rect.y + row)), rect.width * pixel_bytes);
  }
  return bytes;
}

void Film::take(const Rect& rect, const char* picture) {
  for (std::uint32_t y = rect.y; y < rect.y + rect.height; ++y)
    std::memcpy(at(rect.x, y), picture + (std::size_t{y} * width_ + rect.x) * pixel_bytes,
                rect.width * pixel_bytes);
}

void Film::paste(const Rect& rect, std::string_view bytes) {
  assert(bytes.size() == std::size_t{rect.width} * rect.height * pixel_bytes);
  for (std::uint32_t row = 0; row < rect.height; ++row) {
    std::memcpy(at(rect.x, rect.y + row),
                bytes.data() + std::size_t{row} * rect.width * pixel_bytes,
                rect.width * pixel_bytes);
  }
}

}  // namespace metamer::service
