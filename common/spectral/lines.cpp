#include "common/spectral/lines.h"

#include <algorithm>

namespace metamer {

Spectrum with_lines(const Spectrum& continuum, const std::vector<Line>& lines) {
  // Every place where the sum bends.
  std::vector<Spectrum> parts;
  Spectrum sum;
  for (const Line& line : lines) {
    parts.push_back({{line.nm - line_half_width, line.nm, line.nm + line_half_width},
                     {0, line.power / line_half_width, 0}});
    sum.nm.insert(sum.nm.end(), parts.back().nm.begin(), parts.back().nm.end());
  }
  if (!continuum.nm.empty()) {
    // Where a line lies beyond an end of the continuum, this falls to 0 there.
    const double from = continuum.nm.front(), to = continuum.nm.back();
    const auto any = [&](const auto& beyond) {
      return std::any_of(lines.begin(), lines.end(), beyond);
    };
    if (any([&](const Line& line) { return line.nm - line_half_width < from; }))
      sum.nm.push_back(from - line_half_width);
    if (any([&](const Line& line) { return line.nm + line_half_width > to; }))
      sum.nm.push_back(to + line_half_width);
    parts.push_back(continuum);
    sum.nm.insert(sum.nm.end(), continuum.nm.begin(), continuum.nm.end());
  }
  std::sort(sum.nm.begin(), sum.nm.end());
  sum.nm.erase(std::unique(sum.nm.begin(), sum.nm.end()), sum.nm.end());

  // Add each part where it is.
  sum.values.resize(sum.nm.size());
  for (const Spectrum& part : parts) {
    const auto first = std::lower_bound(sum.nm.begin(), sum.nm.end(), part.nm.front());
    const auto end = std::upper_bound(first, sum.nm.end(), part.nm.back());
    auto to = sum.values.begin() + (first - sum.nm.begin());
    for (const double value : resample(part, {first, end}, Outside::zero).values) *to++ += value;
  }
  return sum;
}

Spectrum as_emission(Spectrum spectrum) {
  if (spectrum.nm.size() != 1) return spectrum;
  // A line's height is its power by its width: kept within f64.
  const double power = std::min(spectrum.values.front(), 1e300);
  return with_lines({}, {{spectrum.nm.front(), power}});
}

}  // namespace metamer
