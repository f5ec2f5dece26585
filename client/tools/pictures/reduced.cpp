#include "client/tools/pictures/reduced.h"

#include <algorithm>

namespace metamer::client {
namespace {

int squares(int pixels, int side) { return (pixels + side - 1) / side; }

}  // namespace

Image reduced(const Image& image, const PixelArea& area, int side) {
  const std::size_t channels = image.channels.size();
  Image result = make_image(squares(area.width, side), squares(area.height, side), image.channels);
  for (int y = 0; y < result.height; ++y) {
    const int rows = std::min(side, area.height - y * side);
    for (int row = 0; row < rows; ++row) {
      const float* from = image.at(area.x, area.y + y * side + row);
      for (int x = 0; x < result.width; ++x) {
        float* const to = result.at(x, y);
        for (int column = std::min(side, area.width - x * side); column > 0; --column)
          for (std::size_t c = 0; c < channels; ++c) to[c] += *from++;
      }
    }
    for (int x = 0; x < result.width; ++x) {
      const int pixels = rows * std::min(side, area.width - x * side);
      for (std::size_t c = 0; c < channels; ++c) result.at(x, y)[c] /= static_cast<float>(pixels);
    }
  }
  return result;
}

Image sampled(const Image& image, int side) {
  Image result =
      make_image(squares(image.width, side), squares(image.height, side), image.channels);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      std::copy_n(image.at(x * side, y * side), image.channels.size(), result.at(x, y));
  return result;
}

}  // namespace metamer::client
