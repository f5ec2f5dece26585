#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "common/color/error_statistics.h"
#include "common/image/image.h"

/// How far two pictures are apart, pixel by pixel.
namespace metamer {

enum class Metric { de00, deuv, deab };

/// "ΔE00", "ΔE*uv", "ΔE*ab"
const char* name_of(Metric metric);

struct Difference {
  int width = 0;
  int height = 0;
  std::vector<double> values;  ///< Row by row; NaN where a pixel of either picture is not finite.
  ErrorStatistics statistics;  ///< Places count row by row.
};

/// The differences of two X Y Z pictures; components of `white` are above 0 (see lab.h). Error:
/// they differ in size.
Result<Difference> compare(const Image& a, const Image& b, Metric metric,
                           const std::array<double, 3>& white);

/// A picture (X Y Z, to be written as any other) of the differences, from 0 (black) to `top`
/// (white); what is above is white too and counted in the legend below the picture, and what is not
/// a number is red. `top` 0: the 99th percentile, rounded up. `title` names what is drawn. Error:
/// the legend's font (DejaVu Sans) is not there.
Result<Image> false_color(const Difference& difference, Metric metric, double top,
                          std::string_view title);

}  // namespace metamer
