#include "server/film/sample_pattern.h"

namespace metamer {
namespace {

/// The bits of i mirrored at the binary point.
double radical_inverse(unsigned i) {
  double value = 0;
  for (double digit = 0.5; i != 0; i >>= 1, digit /= 2) value += (i & 1) * digit;
  return value;
}

}  // namespace

std::vector<SamplePoint> sample_pattern(unsigned count) {
  // The inverse's values are multiples of 1 / strata, the next power of two.
  unsigned strata = 1;
  while (strata < count) strata *= 2;
  std::vector<SamplePoint> points;
  for (unsigned i = 0; i < count; ++i)
    points.push_back({static_cast<float>((i + 0.5) / count),
                      static_cast<float>(radical_inverse(i) + 0.5 / strata), i});
  return points;
}

}  // namespace metamer
