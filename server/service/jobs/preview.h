#pragma once

#include <cstdint>
#include <vector>

#include "metamer/v1/jobs.pb.h"
#include "server/service/jobs/film.h"

namespace metamer::service {

/// The picture so far, reduced by whole boxes of pixels until no side is above preview_side. Sums
/// are kept, so that a tile costs its own pixels and a preview never the whole film.
class PreviewSums {
 public:
  PreviewSums() = default;
  PreviewSums(std::uint32_t width, std::uint32_t height);

  /// Adds a rectangle of the film, once.
  void add(const Film& film, const Rect& rect);
  /// The mean of the pixels that are there, as 8-bit sRGB; black where none is.
  v1::Preview encode() const;

 private:
  struct Cell {
    double x = 0;
    double y = 0;
    double z = 0;
    std::uint32_t count = 0;
  };
  std::uint32_t box_ = 1;  // pixels of the film on a side of a cell
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::vector<Cell> cells_;
};

}  // namespace metamer::service
