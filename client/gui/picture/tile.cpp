#include "client/gui/picture/tile.h"

#include <vector>

#include "client/tools/pictures/reduced.h"

namespace metamer::gui {

TileMaker::TileMaker(const ShownXyz& shown, const Viewing& viewing)
    : shown_(shown),
      pixels_(shown.developing),
      exposure_(std::exp2(viewing.stops)),
      gamut_(viewing.gamut) {
  const QColorSpace space = color_space(shown.developing);
  if (space != viewing.display) transform_ = space.transformationToColorSpace(viewing.display);
}

QImage TileMaker::develop(const Image& xyz, const QRect& area) const {
  QImage tile(area.size(), QImage::Format_RGB32);
  for (int y = 0; y < tile.height(); ++y)
    pixels_.develop(xyz.at(area.x(), area.y() + y), static_cast<std::size_t>(tile.width()),
                    exposure_, reinterpret_cast<QRgb*>(tile.scanLine(y)));
  if (!transform_.isIdentity()) tile.applyColorTransform(transform_);
  return tile;
}

/// A pixel of the tile is marked where one of those that it stands for is lost.
void TileMaker::mark(const QRect& area, int side, QImage& tile) const {
  const auto width = static_cast<std::size_t>(area.width());
  std::vector<std::uint8_t> lost(width);
  for (int y = 0; y < area.height(); ++y) {
    std::fill(lost.begin(), lost.end(), std::uint8_t{0});
    if (pixels_.find_lost(shown_.xyz->at(area.x(), area.y() + y), width, exposure_, lost.data()) ==
        0)
      continue;
    auto* const row = reinterpret_cast<QRgb*>(tile.scanLine(y / side));
    for (int x = 0; x < area.width(); ++x)
      if (lost[static_cast<std::size_t>(x)] != 0) row[x / side] = gamut_mark;
  }
}

QImage TileMaker::make(const TilePlace& place) const {
  const QRect area = place.area({shown_.xyz->width, shown_.xyz->height});
  const int side = 1 << place.level;
  QImage tile;
  if (side == 1) {
    tile = develop(*shown_.xyz, area);
  } else {
    const Image means =
        client::reduced(*shown_.xyz, {area.x(), area.y(), area.width(), area.height()}, side);
    tile = develop(means, {0, 0, means.width, means.height});
  }
  if (gamut_) mark(area, side, tile);
  return tile;
}

QImage TileMaker::sample(int side) const {
  if (side == 1) return develop(*shown_.xyz, {0, 0, shown_.xyz->width, shown_.xyz->height});
  const Image samples = client::sampled(*shown_.xyz, side);
  return develop(samples, {0, 0, samples.width, samples.height});
}

std::size_t TileMaker::count_outside() const {
  return pixels_.find_lost(shown_.xyz->pixels.data(), shown_.xyz->pixels.size() / 3, exposure_,
                           nullptr);
}

QImage whole_image(const ShownXyz& shown) {
  const TileMaker own(shown,
                      {.stops = 0, .gamut = false, .display = color_space(shown.developing)});
  return own.sample(1);
}

}  // namespace metamer::gui
