#include "client/tools/pictures/difference_map.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "common/image/ramp.h"

namespace metamer::client {
namespace {

std::uint32_t screen_color(const Rgb& color) {
  std::uint32_t pixel = 0xff;
  for (const double value : color)
    pixel = pixel << 8 | static_cast<std::uint32_t>(std::lround(255 * std::clamp(value, 0., 1.)));
  return pixel;
}

}  // namespace

double usual_top(const Difference& difference) {
  return scale_end(difference.statistics.percentile_99);
}

std::vector<std::uint32_t> map_pixels(const Difference& difference, double top) {
  // So many steps that neighbours differ by less than one code.
  std::array<std::uint32_t, 4097> colors;
  for (std::size_t i = 0; i < colors.size(); ++i)
    colors[i] = screen_color(ramp_color(static_cast<double>(i) / (colors.size() - 1), 1));
  const std::uint32_t no_number = screen_color(ramp_color(std::nan(""), 1));
  std::vector<std::uint32_t> pixels;
  pixels.reserve(difference.values.size());
  for (const double value : difference.values) {
    const double place = std::min(1.0, value / top) * (colors.size() - 1);
    pixels.push_back(std::isfinite(value) ? colors[static_cast<std::size_t>(std::lround(place))]
                                          : no_number);
  }
  return pixels;
}

Histogram difference_histogram(const Difference& difference, std::size_t bins, double top) {
  Histogram histogram{.top = top, .counts = std::vector<std::size_t>(bins)};
  for (const double value : difference.values) {
    if (!std::isfinite(value)) continue;
    if (value >= top)
      ++histogram.above;
    else
      ++histogram.counts[std::min(
          bins - 1, static_cast<std::size_t>(value / top * static_cast<double>(bins)))];
  }
  return histogram;
}

std::size_t pixels_over(const Difference& difference, double limit) {
  return static_cast<std::size_t>(std::count_if(difference.values.begin(), difference.values.end(),
                                                [&](double value) { return !(value <= limit); }));
}

}  // namespace metamer::client
