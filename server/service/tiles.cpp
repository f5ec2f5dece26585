#include "server/service/tiles.h"

#include <algorithm>
#include <cassert>

namespace metamer::service {

TileGrid::TileGrid(std::uint32_t width, std::uint32_t height, std::uint32_t tile_size)
    : width_(width), height_(height), tile_size_(tile_size) {
  assert(width > 0 && height > 0 && tile_size > 0);
  columns_ = (width - 1) / tile_size + 1;
  const std::uint32_t rows = (height - 1) / tile_size + 1;

  // Sort the cells by the distance of their centre from the picture's, in half cells so that it is
  // a whole number; equal ones stay in reading order. A million cells have to be done in an
  // instant.
  std::vector<std::uint64_t> keys(std::size_t{columns_} * rows);
  std::uint32_t cell = 0;
  for (std::uint32_t row = 0; row < rows; ++row) {
    const std::int64_t dy = 2 * std::int64_t{row} + 1 - std::int64_t{rows};
    for (std::uint32_t column = 0; column < columns_; ++column, ++cell) {
      const std::int64_t dx = 2 * std::int64_t{column} + 1 - std::int64_t{columns_};
      keys[cell] = static_cast<std::uint64_t>(dx * dx + dy * dy) << 32 | cell;
    }
  }
  std::sort(keys.begin(), keys.end());
  order_.reserve(keys.size());
  for (const std::uint64_t key : keys) order_.push_back(static_cast<std::uint32_t>(key));
  rank_.resize(order_.size());
  for (std::uint32_t i = 0; i < size(); ++i) rank_[order_[i]] = i;
}

Rect TileGrid::rect(std::uint32_t index) const {
  const std::uint32_t x = order_[index] % columns_ * tile_size_;
  const std::uint32_t y = order_[index] / columns_ * tile_size_;
  return {x, y, std::min(tile_size_, width_ - x), std::min(tile_size_, height_ - y)};
}

std::optional<std::uint32_t> TileGrid::find(const Rect& wanted) const {
  if (wanted.x >= width_ || wanted.y >= height_) return std::nullopt;
  const std::uint32_t index = rank_[wanted.y / tile_size_ * columns_ + wanted.x / tile_size_];
  if (rect(index) != wanted) return std::nullopt;
  return index;
}

}  // namespace metamer::service
