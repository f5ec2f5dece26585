#pragma once

#include <cstddef>
#include <cstdint>

#include "common/color/eight_bit.h"
#include "common/image/image.h"

namespace metamer::client {

/// X Y Z as the pixels of a screen: the numbers of write_image's 8-bit .png, for pictures that are
/// shown while they grow. Copies are cheap beside a picture; any thread.
class ScreenPixels {
 public:
  explicit ScreenPixels(const Developing& developing);

  /// Develops a run of `pixels`, three values each, times `exposure`, into 0xffRRGGBB each. Returns
  /// what clipping lost.
  GamutReport develop(const float* xyz, std::size_t pixels, double exposure,
                      std::uint32_t* screen) const;

  /// How many of these pixels have a value that clipping changes; their `lost` becomes 1, that of
  /// the others stays. A null `lost`: they are only counted.
  std::size_t find_lost(const float* xyz, std::size_t pixels, double exposure,
                        std::uint8_t* lost) const;

 private:
  Matrix3 matrix_;
  EightBit codes_;
};

}  // namespace metamer::client
