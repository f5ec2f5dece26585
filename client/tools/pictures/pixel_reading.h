#pragma once

#include <optional>
#include <span>

#include "common/color/lab.h"
#include "common/color/rgb_space.h"
#include "common/image/image.h"

/// What is said of a place in a picture.
namespace metamer::client {

struct PixelReading {
  Xyz xyz;
  std::optional<Lab> lab;  ///< Nothing: no white is known, or it has a component of 0.
  Rgb encoded;             ///< Of the developing's space, not clipped: 0..1 is in gamut.
  bool in_gamut;           ///< As a .png counts it.
};

/// Of X Y Z as rendered; `white` is what looks white.
PixelReading read_color(const Xyz& xyz, const std::optional<Xyz>& white,
                        const Developing& developing);

/// A square of `side` pixels (at least 1) around a pixel, as far as it lies in the picture, in
/// which the pixel lies: as v1::Probe has it. Ends are included.
struct PixelSquare {
  int left, top, right, bottom;
  double count() const { return (right - left + 1.0) * (bottom - top + 1.0); }
};
PixelSquare pixel_square(int width, int height, int x, int y, int side);

/// The mean over a square.
Xyz mean_xyz(const Image& xyz, int x, int y, int side);
/// The standard deviation over a square, of each component by itself: that of all its pixels, not
/// an estimate from a sample of more.
Xyz spread_xyz(const Image& xyz, int x, int y, int side);

}  // namespace metamer::client
