#include "server/scene/environment/sky_tables.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace metamer {

SkyTables sky_tables(const SkyPicture& picture, std::vector<double> luminances, double ground) {
  SkyTables tables;
  tables.ground = ground;
  tables.luminances = std::move(luminances);
  // What is not seen is light all the same: no sample may miss it.
  const auto parts = static_cast<double>(tables.luminances.size());
  for (double& luminance : tables.luminances)
    luminance = std::max({luminance, 1e-3 / parts, 1e-30});

  const std::uint32_t width = picture.width, height = picture.height;
  for (std::uint32_t y = 0; y <= height; ++y)
    tables.edges.push_back(static_cast<float>(std::cos(y * std::numbers::pi / height)));
  tables.up_to_pixel.resize(std::size_t{width} * height);
  std::vector<double> rows, pixels(width);
  for (std::uint32_t y = 0; y < height; ++y) {
    double row = 0;
    for (std::uint32_t x = 0; x < width; ++x)
      row += pixels[x] = tables.brightness(picture.at(x, y));
    double sum = 0;
    for (std::uint32_t x = 0; x < width; ++x)
      tables.up_to_pixel[std::size_t{y} * width + x] =
          static_cast<float>((sum += pixels[x]) / (row > 0 ? row : 1));
    rows.push_back(row * double{tables.edges[y] - tables.edges[y + 1]} * 2 * std::numbers::pi /
                   width);
    tables.whole += rows.back();
  }
  double sum = 0;
  for (const double row : rows) {
    tables.up_to_row.push_back(static_cast<float>(sum / tables.whole));
    sum += row;
  }
  tables.up_to_row.push_back(1);
  return tables;
}

}  // namespace metamer
