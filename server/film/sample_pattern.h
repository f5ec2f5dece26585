#pragma once

#include <cstdint>
#include <vector>

namespace metamer {

/// Where in a pixel its samples lie, both in (0, 1).
struct SamplePoint {
  float x, y;
  std::uint32_t number = 0;  ///< In the pattern.
};

/// The fixed stratified pattern of `count` samples, the same in every pixel: the Hammersley set,
/// moved to the middle of its strata. It has one sample in each of `count` columns and rows, and
/// where `count` is a power of two, in each elementary interval (Niederreiter 1992, 3.1).
std::vector<SamplePoint> sample_pattern(unsigned count);

}  // namespace metamer
