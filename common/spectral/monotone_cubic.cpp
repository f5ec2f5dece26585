#include "common/spectral/monotone_cubic.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace metamer {
namespace {

/// A stretch between two samples: how long it is, and how steep its chord.
struct Chord {
  double width, slope;
};

Chord chord(const Spectrum& samples, std::size_t left) {
  const double width = samples.nm[left + 1] - samples.nm[left];
  return {width, (samples.values[left + 1] - samples.values[left]) / width};
}

double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// Equations 8 and 11: the slope of the parabola through three samples at the middle one, as far as
/// it keeps both sides monotone.
double inner_slope(const Chord& left, const Chord& right) {
  const double parabola =
      (left.slope * right.width + right.slope * left.width) / (left.width + right.width);
  return (sign(left.slope) + sign(right.slope)) *
         std::min({std::abs(left.slope), std::abs(right.slope), std::abs(parabola) / 2});
}

/// Equations 24 to 29: the same at the first sample or the last, of which `end` is the stretch.
double end_slope(const Chord& end, const Chord& next) {
  const double share = end.width / (end.width + next.width);
  const double parabola = end.slope * (1 + share) - next.slope * share;
  if (parabola * end.slope <= 0) return 0;
  return std::abs(parabola) > 2 * std::abs(end.slope) ? 2 * end.slope : parabola;
}

std::vector<double> slopes(const Spectrum& samples) {
  const std::size_t last = samples.nm.size() - 1;
  std::vector<double> result = {end_slope(chord(samples, 0), chord(samples, 1))};
  for (std::size_t i = 1; i < last; ++i)
    result.push_back(inner_slope(chord(samples, i - 1), chord(samples, i)));
  result.push_back(end_slope(chord(samples, last - 1), chord(samples, last - 2)));
  return result;
}

}  // namespace

std::optional<std::string> monotone_cubic_fault(const Spectrum& samples) {
  if (samples.nm.size() >= 3) return std::nullopt;
  return "a monotone cubic takes 3 samples at least, not " + std::to_string(samples.nm.size());
}

Result<std::vector<double>> monotone_cubic(const Spectrum& samples, const std::vector<double>& nm) {
  if (auto fault = monotone_cubic_fault(samples)) return problem(std::move(*fault));
  const std::vector<double> steep = slopes(samples);
  std::vector<double> result;
  result.reserve(nm.size());
  for (const double x : nm) {
    assert(x >= samples.nm.front() && x <= samples.nm.back());
    const auto right = std::lower_bound(samples.nm.begin(), samples.nm.end(), x);
    const auto k = static_cast<std::size_t>(right - samples.nm.begin());
    if (*right == x) {
      result.push_back(samples.values[k]);
      continue;
    }
    // Equations 2 to 5.
    const auto [width, slope] = chord(samples, k - 1);
    const double a = (steep[k - 1] + steep[k] - 2 * slope) / (width * width),
                 b = (3 * slope - 2 * steep[k - 1] - steep[k]) / width, t = x - samples.nm[k - 1];
    result.push_back(samples.values[k - 1] + t * (steep[k - 1] + t * (b + t * a)));
  }
  return result;
}

}  // namespace metamer
