#include "client/tools/pictures/swatches.h"

#include <algorithm>

#include "client/tools/text/formatted.h"
#include "common/color/adaptation.h"
#include "common/color/xyz.h"
#include "common/image/labels.h"

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

Result<Image> swatches(const std::vector<PaintMatch>& matches) {
  constexpr int half = swatch_size / 2, column = swatch_size + swatch_gap;
  constexpr int row = swatch_size + swatch_text + swatch_gap, edge = swatch_gap;
  const int columns = static_cast<int>(matches.front().under.size());
  const int rows = static_cast<int>(matches.size());
  Image image = make_image(swatch_names + columns * column + edge, swatch_text + rows * row + edge,
                           {"X", "Y", "Z"});
  Xyz grey = d65_white();
  for (double& value : grey) value *= 0.2;
  fill(image, {0, 0, image.width, image.height}, grey);
  std::vector<Label> labels;
  int top = swatch_text + edge;
  for (const PaintMatch& match : matches) {
    const int middle = top + swatch_size / 2 + label_height / 2;
    labels.push_back(
        {.x = edge, .y = middle, .words = match.name, .width = swatch_names - 2 * edge});
    int left = swatch_names;
    for (const Mismatch& under : match.under) {
      fill(image, {left, top, half, swatch_size}, on_screen(under.one, under.white));
      fill(image, {left + half, top, half, swatch_size}, on_screen(under.other, under.white));
      if (&match == &matches.front())
        labels.push_back({.x = left, .y = swatch_text, .words = under.light, .width = swatch_size});
      labels.push_back({.x = left,
                        .y = top + swatch_size + label_height + 3,
                        .words = formatted("dE00 %.2f", under.de00)});
      left += column;
    }
    top += row;
  }
  if (auto drawn = draw_labels(image, labels); !drawn)
    return tl::unexpected(std::move(drawn.error()));
  return image;
}

}  // namespace metamer::client
