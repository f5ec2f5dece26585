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
  const Matrix3 m = matrix;  // no store can change it
  for (std::size_t i = 0; i < 3 * pixels; i += 3) {
    const double x = xyz[i], y = xyz[i + 1], z = xyz[i + 2];
    for (std::size_t row = 0; row < 3; ++row)
      rgb[i + row] = static_cast<float>(m[row][0] * x + m[row][1] * y + m[row][2] * z);
  }
}

}  // namespace metamer
