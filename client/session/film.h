#pragma once

#include <cstddef>
#include <vector>

#include "client/session/error.h"
#include "common/image/image.h"
#include "metamer/v1/jobs.pb.h"
#include "metamer/v1/plan.pb.h"

namespace metamer::client {

/// The picture that grows out of a job's tiles: X, Y, Z in f32.
class Film {
 public:
  /// A black picture of the plan's size. Error: a size over the limits, which no server sends.
  static Answer<Film> make(const v1::Plan& plan);

  /// Puts a tile in its place. Error: it lies outside, its bytes do not fit its size, or one of
  /// its pixels came before.
  Answer<void> add(const v1::Tile& tile);

  bool complete() const { return missing_ == 0; }
  std::size_t missing() const { return missing_; }  ///< Pixels.
  const Image& image() const { return image_; }

 private:
  Image image_;
  std::vector<bool> have_;
  std::size_t missing_ = 0;
};

/// A preview as an XYZ image, so that it can be written like any other.
Answer<Image> preview_image(const v1::Preview& preview);

}  // namespace metamer::client
