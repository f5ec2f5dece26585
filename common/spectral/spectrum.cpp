#include "common/spectral/spectrum.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/spectral/value_bounds.h"

namespace metamer {

Result<Spectrum> make_spectrum(std::vector<double> nm, std::vector<double> values) {
  if (nm.size() != values.size()) {
    return problem(std::to_string(nm.size()) + " wavelengths but " + std::to_string(values.size()) +
                   " values");
  }
  if (auto wrong = wrong_positions(nm)) return problem(std::move(*wrong));
  double peak = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      return problem("the value at " + number_text(nm[i]) + " nm is not finite");
    }
    peak = std::max(peak, std::abs(values[i]));
    if (peak > most_value)
      return problem("the value at " + number_text(nm[i]) + " nm, " + number_text(values[i]) +
                     ", is too large: at most " + number_text(most_value) + " can be summed");
  }
  if (peak > 0 && peak < least_peak)
    return problem("the largest value, " + number_text(peak) + ", is too small: at least " +
                   number_text(least_peak) + " can be summed");
  return Spectrum{.nm = std::move(nm), .values = std::move(values)};
}

Resampled resample(const Spectrum& spectrum, const std::vector<double>& nm, Outside outside) {
  assert(!spectrum.nm.empty() && spectrum.nm.size() == spectrum.values.size());
  Resampled result;
  result.values.reserve(nm.size());
  auto right = spectrum.nm.begin();  // goes on from where it was: most positions rise
  for (const double x : nm) {
    // Outside the data.
    if (x < spectrum.nm.front()) {
      ++result.below;
      result.values.push_back(outside == Outside::hold ? spectrum.values.front() : 0.0);
      continue;
    }
    if (x > spectrum.nm.back()) {
      ++result.above;
      result.values.push_back(outside == Outside::hold ? spectrum.values.back() : 0.0);
      continue;
    }

    // At a sample, its very value; between two, the straight line.
    if (right != spectrum.nm.begin() && right[-1] >= x)
      right = std::lower_bound(spectrum.nm.begin(), right, x);
    while (*right < x) ++right;
    const auto i = static_cast<std::size_t>(right - spectrum.nm.begin());
    if (*right == x) {
      result.values.push_back(spectrum.values[i]);
      continue;
    }
    const double t = (x - spectrum.nm[i - 1]) / (spectrum.nm[i] - spectrum.nm[i - 1]);
    result.values.push_back((1 - t) * spectrum.values[i - 1] + t * spectrum.values[i]);
  }
  return result;
}

}  // namespace metamer
