#include "common/spectral/interpolation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/spectral/monotone_cubic.h"
#include "common/spectral/sprague.h"

namespace metamer {
namespace {

constexpr double near_sample = 1e-6;  ///< nm: no place for another value beside a sample.
constexpr std::size_t least_samples = 6;
constexpr double fine_step = 1.001;  ///< nm: 1, and what decimal fractions make of it.

/// Those of `nm` that lie between the samples and are none.
std::vector<double> between_samples(const Spectrum& samples, const std::vector<double>& nm) {
  std::vector<double> result;
  for (const double x : nm) {
    const auto right = std::lower_bound(samples.nm.begin(), samples.nm.end(), x);
    if (right == samples.nm.begin() || right == samples.nm.end()) continue;
    if (*right - x > near_sample && x - *(right - 1) > near_sample) result.push_back(x);
  }
  return result;
}

/// The interpolant's values at places between the samples.
Result<std::vector<double>> values_at(const Spectrum& samples, Interpolation interpolation,
                                      const std::vector<double>& nm) {
  switch (interpolation) {
    case Interpolation::linear:
      return resample(samples, nm, Outside::hold).values;
    case Interpolation::sprague:
      return sprague(samples, nm);
    case Interpolation::monotone_cubic:
      return monotone_cubic(samples, nm);
  }
  return {};
}

double median_step(const std::vector<double>& nm) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < nm.size(); ++i) steps.push_back(nm[i] - nm[i - 1]);
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

}  // namespace

const std::vector<std::string>& interpolation_words() {
  static const std::vector<std::string> words = {"linear", "sprague", "monotone-cubic"};
  return words;
}

std::optional<Interpolation> find_interpolation(std::string_view word) {
  const auto& words = interpolation_words();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) return std::nullopt;
  return static_cast<Interpolation>(found - words.begin());
}

const std::string& word_of(Interpolation interpolation) {
  return interpolation_words()[static_cast<std::size_t>(interpolation)];
}

std::optional<std::string> interpolation_fault(const Spectrum& samples,
                                               Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::linear:
      return std::nullopt;
    case Interpolation::sprague:
      return sprague_fault(samples);
    case Interpolation::monotone_cubic:
      return monotone_cubic_fault(samples);
  }
  return std::nullopt;
}

Result<Interpolated> interpolated(const Spectrum& samples, Interpolation interpolation,
                                  const ValueRange& range, const std::vector<double>& nm) {
  if (interpolation == Interpolation::linear) return Interpolated{samples, interpolation};
  const std::vector<double> places = between_samples(samples, nm);
  const auto values = values_at(samples, interpolation, places);
  if (!values) return tl::unexpected<Problem>(values.error());

  Interpolated result{{{samples.nm.front()}, {samples.values.front()}}, interpolation};
  Spectrum& spectrum = result.spectrum;
  std::size_t k = 0;
  for (std::size_t i = 1; i < samples.nm.size(); ++i) {
    // The places of this stretch, if the interpolant keeps to the range at all of them.
    const std::size_t first = k;
    bool keeps = true;
    for (; k < places.size() && places[k] < samples.nm[i]; ++k) {
      const double value = (*values)[k];
      keeps = keeps && std::isfinite(value) && value >= range.low && value <= range.high;
    }
    if (!keeps) ++result.straight;
    for (std::size_t j = first; keeps && j < k; ++j) {
      spectrum.nm.push_back(places[j]);
      spectrum.values.push_back((*values)[j]);
    }
    spectrum.nm.push_back(samples.nm[i]);
    spectrum.values.push_back(samples.values[i]);
  }
  return result;
}

Result<double> curvature(const Spectrum& samples, Interpolation interpolation) {
  const std::vector<double> seen = observer_wavelengths().nm();
  const std::vector<double> places = between_samples(samples, seen);
  const auto curve = values_at(samples, interpolation, places);
  if (!curve) return tl::unexpected<Problem>(curve.error());
  const std::vector<double> lines = resample(samples, places, Outside::zero).values;
  double largest = 0, farthest = 0;
  for (std::size_t i = 0; i < samples.nm.size(); ++i)
    if (samples.nm[i] >= seen.front() && samples.nm[i] <= seen.back())
      largest = std::max(largest, samples.values[i]);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double off = std::abs((*curve)[i] - lines[i]);
    if (!std::isfinite(off)) return HUGE_VAL;
    farthest = std::max(farthest, off);
  }
  return largest > 0 ? farthest / largest : farthest;
}

Interpolation recommended_interpolation(const Spectrum& samples, Outside outside) {
  if (samples.nm.size() < least_samples || median_step(samples.nm) <= fine_step)
    return Interpolation::linear;
  const auto curve = interpolation_fault(samples, Interpolation::sprague)
                         ? Interpolation::monotone_cubic
                         : Interpolation::sprague;
  if (outside == Outside::hold) return curve;
  const auto off = curvature(samples, curve);
  return off && *off <= smooth_curvature ? curve : Interpolation::linear;
}

}  // namespace metamer
