#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>

#include "server/service/jobs/tiles.h"

namespace metamer::service {

/// The picture of a job: width × height × (X, Y, Z) f32, row by row from the top, black at first.
/// Memory is taken as pixels come.
class Film {
 public:
  Film() = default;
  /// May fail: see ok().
  Film(std::uint32_t width, std::uint32_t height);

  bool ok() const { return pixels_ != nullptr; }
  std::uint32_t width() const { return width_; }
  std::uint32_t height() const { return height_; }
  std::size_t bytes() const { return std::size_t{width_} * height_ * pixel_bytes; }

  float* at(std::uint32_t x, std::uint32_t y) {
    return pixels_.get() + (std::size_t{y} * width_ + x) * 3;
  }
  const float* at(std::uint32_t x, std::uint32_t y) const {
    return const_cast<Film*>(this)->at(x, y);
  }
  /// The pixels of a rectangle as a Tile carries them.
  std::string copy(const Rect& rect) const;

  /// Takes them out of another picture of the same size.
  void take(const Rect& rect, const char* picture);
  /// Takes them: as many bytes as the rectangle has.
  void paste(const Rect& rect, std::string_view bytes);

  static constexpr std::size_t pixel_bytes = 3 * sizeof(float);

 private:
  struct Free {
    void operator()(float* pixels) const { std::free(pixels); }
  };
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
  std::unique_ptr<float[], Free> pixels_;
};

}  // namespace metamer::service
