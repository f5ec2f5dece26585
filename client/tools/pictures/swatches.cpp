#include "client/tools/pictures/swatches.h"

#include <algorithm>

#include "common/color/adaptation.h"
#include "common/color/xyz.h"

namespace metamer::client {
namespace {

Xyz d65_white() { return white_xyz(rgb_space(StandardSpace::srgb).primaries.white); }

/// As a screen of D65 shows it; a white too saturated to be adapted stays.
Xyz on_screen(const Xyz& xyz, const Xyz& white) {
  const auto matrix = adaptation_matrix(Adaptation::bradford, white, d65_white());
  return matrix ? multiply(*matrix, xyz) : xyz;
}

struct Box {
  int left, top, width, height;
};

void fill(Image& image, const Box& box, const Xyz& color) {
  for (int y = box.top; y < box.top + box.height; ++y)
    for (int x = box.left; x < box.left + box.width; ++x)
      std::transform(color.begin(), color.end(), image.at(x, y),
                     [](double value) { return static_cast<float>(value); });
}

}  // namespace

Image swatches(const std::vector<PaintMatch>& matches) {
  constexpr int half = swatch_size / 2, pitch = swatch_size + swatch_gap;
  const int columns = static_cast<int>(matches.front().under.size());
  const int rows = static_cast<int>(matches.size());
  Image image =
      make_image(columns * pitch + swatch_gap, rows * pitch + swatch_gap, {"X", "Y", "Z"});
  Xyz grey = d65_white();
  for (double& value : grey) value *= 0.2;
  fill(image, {0, 0, image.width, image.height}, grey);
  int top = swatch_gap;
  for (const PaintMatch& match : matches) {
    int left = swatch_gap;
    for (const Mismatch& under : match.under) {
      fill(image, {left, top, half, swatch_size}, on_screen(under.one, under.white));
      fill(image, {left + half, top, half, swatch_size}, on_screen(under.other, under.white));
      left += pitch;
    }
    top += pitch;
  }
  return image;
}

}  // namespace metamer::client
