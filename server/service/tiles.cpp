#include "server/service/tiles.h"

#include <algorithm>
#include <cassert>
#include <numeric>

namespace metamer::service {

TileGrid::TileGrid(std::uint32_t width, std::uint32_t height, std::uint32_t tile_size)
    : width_(width), height_(height), tile_size_(tile_size) {
  assert(width > 0 && height > 0 && tile_size > 0);
  columns_ = (width - 1) / tile_size + 1;
  const std::uint32_t rows = (height - 1) / tile_size + 1;

  // Sort the cells by the distance of their centre from the picture's, both in half cells so that
  // the numbers are whole; equal ones stay in reading order.
  const auto distance = [&](std::uint32_t cell) {
    const std::int64_t dx = 2 * std::int64_t{cell % columns_} + 1 - std::int64_t{columns_};
    const std::int64_t dy = 2 * std::int64_t{cell / columns_} + 1 - std::int64_t{rows};
    return dx * dx + dy * dy;
  };
  order_.resize(std::size_t{columns_} * rows);
  std::iota(order_.begin(), order_.end(), 0u);
  std::stable_sort(order_.begin(), order_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return distance(a) < distance(b); });
  place_.resize(order_.size());
  for (std::uint32_t i = 0; i < size(); ++i) place_[order_[i]] = i;
}

Rect TileGrid::rect(std::uint32_t index) const {
  const std::uint32_t x = order_[index] % columns_ * tile_size_;
  const std::uint32_t y = order_[index] / columns_ * tile_size_;
  return {x, y, std::min(tile_size_, width_ - x), std::min(tile_size_, height_ - y)};
}

std::optional<std::uint32_t> TileGrid::find(const Rect& wanted) const {
  if (wanted.x >= width_ || wanted.y >= height_) return std::nullopt;
  const std::uint32_t index = place_[wanted.y / tile_size_ * columns_ + wanted.x / tile_size_];
  if (rect(index) != wanted) return std::nullopt;
  return index;
}

}  // namespace metamer::service
