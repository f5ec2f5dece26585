#pragma once

#include <cstdint>
#include <optional>

#include "metamer/v1/worker.pb.h"

namespace metamer::wire {

struct Rect {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  bool operator==(const Rect&) const = default;
};

/// A picture cut into squares of `tile_size` pixels (smaller at the right and bottom edges), in the
/// order in which they are rendered: the centre first, where the eye looks, then ring by ring
/// around it, each in reading order. Computed, not kept: a table of four million tiles would take
/// the time and the memory of a small picture.
class TileGrid {
 public:
  TileGrid() = default;
  /// All at least 1.
  TileGrid(std::uint32_t width, std::uint32_t height, std::uint32_t tile_size);

  std::uint32_t size() const { return columns_ * rows_; }
  /// The rectangle of the tile that is rendered as number `index`.
  Rect rect(std::uint32_t index) const;
  /// Which tile that rectangle is; nothing when it is none.
  std::optional<std::uint32_t> find(const Rect& rect) const;

 private:
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::uint32_t tile_size_ = 1;
  std::uint32_t columns_ = 0;
  std::uint32_t rows_ = 0;
};

inline Rect to_rect(const v1::TileRect& message) {
  return {message.x(), message.y(), message.width(), message.height()};
}

}  // namespace metamer::wire
