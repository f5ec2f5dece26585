#include "server/service/jobs/preview.h"

#include <algorithm>
#include <cmath>

#include "common/color/srgb.h"
#include "server/service/limits.h"

namespace metamer::service {

namespace {

/// A channel's byte. Not a number counts as black: a worker's pixels are not trusted.
char to_byte(double linear) {
  if (!(linear > 0)) return 0;
  const double encoded = srgb::encode(std::min(linear, 1.0));
  return static_cast<char>(static_cast<unsigned char>(std::lround(encoded * 255)));
}

}  // namespace

PreviewSums::PreviewSums(std::uint32_t width, std::uint32_t height)
    : box_((std::max(width, height) - 1) / preview_side + 1),
      width_((width - 1) / box_ + 1),
      height_((height - 1) / box_ + 1),
      cells_(std::size_t{width_} * height_) {}

void PreviewSums::add(const Film& film, const Rect& rect) {
  for (std::uint32_t y = rect.y; y < rect.y + rect.height; ++y) {
    const float* pixel = film.at(rect.x, y);
    Cell* row = cells_.data() + std::size_t{y / box_} * width_;
    for (std::uint32_t x = rect.x; x < rect.x + rect.width; ++x, pixel += 3) {
      Cell& cell = row[x / box_];
      cell.x += double{pixel[0]};
      cell.y += double{pixel[1]};
      cell.z += double{pixel[2]};
      ++cell.count;
    }
  }
}

v1::Preview PreviewSums::encode() const {
  v1::Preview preview;
  preview.set_width(width_);
  preview.set_height(height_);
  std::string& rgb = *preview.mutable_rgb();
  rgb.reserve(cells_.size() * 3);
  for (const Cell& cell : cells_) {
    const double scale = cell.count > 0 ? 1.0 / cell.count : 0.0;
    for (const double channel : srgb::from_xyz({cell.x * scale, cell.y * scale, cell.z * scale})) {
      rgb.push_back(to_byte(channel));
    }
  }
  return preview;
}

}  // namespace metamer::service
