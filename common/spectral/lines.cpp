#include "common/spectral/lines.h"

#include <algorithm>

namespace metamer {

Spectrum with_lines(const Spectrum& continuum, const std::vector<Line>& lines) {
  // Every place where the sum bends; both sides of the continuum's ends, as it stops there.
  std::vector<Spectrum> parts;
  for (const Line& line : lines)
    parts.push_back({{line.nm - line_half_width, line.nm, line.nm + line_half_width},
                     {0, line.power / line_half_width, 0}});
  Spectrum sum;
  if (!continuum.nm.empty()) {
    parts.push_back(continuum);
    sum.nm = {continuum.nm.front() - line_half_width, continuum.nm.back() + line_half_width};
  }
  for (const Spectrum& part : parts) sum.nm.insert(sum.nm.end(), part.nm.begin(), part.nm.end());
  std::sort(sum.nm.begin(), sum.nm.end());
  sum.nm.erase(std::unique(sum.nm.begin(), sum.nm.end()), sum.nm.end());
  sum.values.resize(sum.nm.size());
  for (const Spectrum& part : parts) {
    const std::vector<double> values = resample(part, sum.nm, Outside::zero).values;
    for (std::size_t i = 0; i < values.size(); ++i) sum.values[i] += values[i];
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
