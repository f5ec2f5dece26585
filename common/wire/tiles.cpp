#include "common/wire/tiles.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace metamer::wire {

namespace {

/// Of `count` cells in a row, those whose centre is at most `d` half cells from the row's middle.
struct Span {
  std::uint32_t begin;
  std::uint32_t size;
};

Span middle(std::uint32_t count, std::uint32_t d) {
  const std::uint32_t within = count % 2 == 1 ? d / 2 * 2 + 1 : (d + 1) / 2 * 2;
  const std::uint32_t size = std::min(count, within);
  return {(count - size) / 2, size};
}

/// All cells at most `d` half cells, the longer way, from the middle of columns × rows.
struct Box {
  Span x;
  Span y;
  Box(std::uint32_t columns, std::uint32_t rows, std::uint32_t d)
      : x(middle(columns, d)), y(middle(rows, d)) {}
  std::uint32_t size() const { return x.size * y.size; }
};

/// The cells of `outer` that are not in `inner`, numbered in reading order.
class Ring {
 public:
  Ring(const Box& outer, const Box& inner) : outer_(outer), inner_(inner) {
    if (inner.size() == 0) inner_.x.size = inner_.y.size = 0, inner_.y.begin = outer.y.begin;
    top_ = (inner_.y.begin - outer_.y.begin) * outer_.x.size;
    side_ = outer_.x.size - inner_.x.size;
    left_ = inner_.x.size == 0 ? side_ : inner_.x.begin - outer_.x.begin;
  }

  std::pair<std::uint32_t, std::uint32_t> cell(std::uint32_t number) const {
    if (number < top_) return in_rows(outer_.y.begin, number);
    const std::uint32_t beside = number - top_;
    if (beside >= side_ * inner_.y.size)
      return in_rows(inner_.y.begin + inner_.y.size, beside - side_ * inner_.y.size);
    const std::uint32_t at = beside % side_;
    return {outer_.x.begin + at + (at < left_ ? 0 : inner_.x.size),
            inner_.y.begin + beside / side_};
  }

  std::uint32_t number(std::uint32_t column, std::uint32_t row) const {
    const std::uint32_t x = column - outer_.x.begin;
    if (row < inner_.y.begin) return (row - outer_.y.begin) * outer_.x.size + x;
    const std::uint32_t down = row - inner_.y.begin;
    if (down < inner_.y.size) return top_ + down * side_ + (x < left_ ? x : x - inner_.x.size);
    return top_ + side_ * inner_.y.size + (down - inner_.y.size) * outer_.x.size + x;
  }

 private:
  std::pair<std::uint32_t, std::uint32_t> in_rows(std::uint32_t first, std::uint32_t number) const {
    return {outer_.x.begin + number % outer_.x.size, first + number / outer_.x.size};
  }

  Box outer_;
  Box inner_;
  std::uint32_t top_;   // cells of the rows above the inner box
  std::uint32_t side_;  // cells of a row beside it
  std::uint32_t left_;  // of these, those on its left
};

/// The ring at a distance of `d` half cells, and the number of cells in those before it.
std::pair<Ring, std::uint32_t> ring(std::uint32_t columns, std::uint32_t rows, std::uint32_t d) {
  const Box outer(columns, rows, d);
  if (d == 0) return {Ring(outer, Box(0, 0, 0)), 0};
  const Box inner(columns, rows, d - 1);
  return {Ring(outer, inner), inner.size()};
}

/// Half cells from the middle.
std::uint32_t distance(std::uint32_t at, std::uint32_t count) {
  const std::uint32_t twice = 2 * at + 1;
  return twice > count ? twice - count : count - twice;
}

}  // namespace

TileGrid::TileGrid(std::uint32_t width, std::uint32_t height, std::uint32_t tile_size)
    : width_(width),
      height_(height),
      tile_size_(tile_size),
      columns_((width - 1) / tile_size + 1),
      rows_((height - 1) / tile_size + 1) {
  assert(width > 0 && height > 0 && tile_size > 0);
}

Rect TileGrid::rect(std::uint32_t index) const {
  // The nearest ring that ends beyond the index.
  std::uint32_t low = 0;
  std::uint32_t high = std::max(columns_, rows_);
  while (low < high) {
    const std::uint32_t d = (low + high) / 2;
    if (Box(columns_, rows_, d).size() > index)
      high = d;
    else
      low = d + 1;
  }
  const auto [around, before] = ring(columns_, rows_, low);
  const auto [column, row] = around.cell(index - before);
  const std::uint32_t x = column * tile_size_;
  const std::uint32_t y = row * tile_size_;
  return {x, y, std::min(tile_size_, width_ - x), std::min(tile_size_, height_ - y)};
}

std::optional<std::uint32_t> TileGrid::find(const Rect& wanted) const {
  if (wanted.x >= width_ || wanted.y >= height_) return std::nullopt;
  const std::uint32_t column = wanted.x / tile_size_;
  const std::uint32_t row = wanted.y / tile_size_;
  const std::uint32_t d = std::max(distance(column, columns_), distance(row, rows_));
  const auto [around, before] = ring(columns_, rows_, d);
  const std::uint32_t index = before + around.number(column, row);
  if (rect(index) != wanted) return std::nullopt;
  return index;
}

}  // namespace metamer::wire
