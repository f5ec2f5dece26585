#include "client/tools/pictures/swatches.h"

#include <algorithm>

#include "common/color/adaptation.h"
#include "common/color/xyz.h"

namespace metamer::client {
namespace {

/// As a screen of D65 shows it; a white too saturated to be adapted stays.
Xyz on_screen(const Xyz& xyz, const Xyz& white) {
  const Xyz d65 = white_xyz(rgb_space(StandardSpace::srgb).primaries.white);
  const auto matrix = adaptation_matrix(Adaptation::bradford, white, d65);
  return matrix ? multiply(*matrix, xyz) : xyz;
}

void fill(Image& image, int left, int top, int width, const Xyz& color) {
  for (int y = top; y < top + swatch_size; ++y)
    for (int x = left; x < left + width; ++x)
      std::transform(color.begin(), color.end(), image.at(x, y),
                     [](double value) { return static_cast<float>(value); });
}

}  // namespace

Image swatches(const std::vector<PaintMatch>& matches) {
  const int columns = static_cast<int>(matches.front().under.size());
  Image image = make_image(columns * swatch_size, static_cast<int>(matches.size()) * swatch_size,
                           {"X", "Y", "Z"});
  constexpr int half = swatch_size / 2;
  int top = 0;
  for (const PaintMatch& match : matches) {
    int left = 0;
    for (const Mismatch& under : match.under) {
      fill(image, left, top, half, on_screen(under.one, under.white));
      fill(image, left + half, top, half, on_screen(under.other, under.white));
      left += swatch_size;
    }
    top += swatch_size;
  }
  return image;
}

}  // namespace metamer::client
