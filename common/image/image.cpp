#include "common/image/image.h"

#include <cassert>

namespace metamer {

Image make_image(int width, int height, std::vector<std::string> channels) {
  assert(width > 0 && height > 0 && !channels.empty());
  Image image{.width = width, .height = height, .channels = std::move(channels), .pixels = {}};
  image.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                      image.channels.size());
  return image;
}

void to_linear_rgb(const Matrix3& matrix, const float* xyz, float* rgb, std::size_t pixels) {
  for (std::size_t i = 0; i < pixels; ++i, xyz += 3, rgb += 3) {
    const Rgb linear = multiply(matrix, Xyz{xyz[0], xyz[1], xyz[2]});
    for (std::size_t c = 0; c < 3; ++c) rgb[c] = static_cast<float>(linear[c]);
  }
}

}  // namespace metamer
