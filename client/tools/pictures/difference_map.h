#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/image/compare.h"

/// Differences of two pictures as they are looked at.
namespace metamer::client {

/// Where the scale of a map ends where nobody says it, as false_color has it.
double usual_top(const Difference& difference);

/// Row by row, 0xffRRGGBB: black at 0, white at `top` and above, red where there is no number.
std::vector<std::uint32_t> map_pixels(const Difference& difference, double top);

/// How many pixels differ by how much.
struct Histogram {
  double top = 1;                   ///< End of the last bin; bins are alike, from 0.
  std::vector<std::size_t> counts;  ///< A difference at an edge is in the bin above it.
  std::size_t above = 0;            ///< At `top` and more. What is not finite is not counted.
};
/// `bins` is at least 1, `top` above 0.
Histogram difference_histogram(const Difference& difference, std::size_t bins, double top);

/// Pixels that differ by more than the limit, or have no number.
std::size_t pixels_over(const Difference& difference, double limit);

}  // namespace metamer::client
