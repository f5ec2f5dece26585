#include "common/spectral/sprague.h"

#include <array>
#include <cassert>
#include <cmath>
#include <utility>

namespace metamer {
namespace {

using Six = std::array<double, 6>;

constexpr double alike = 1e-6;  ///< Of a step.

double dot(const Six& weights, const double* values) {
  double sum = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) sum += weights[i] * values[i];
  return sum;
}

/// The samples with two more at each end: CIE 167:2005, equations 4 to 7.
std::vector<double> extended(const std::vector<double>& values) {
  static constexpr Six second = {884, -1960, 3033, -2648, 1080, -180};
  static constexpr Six first = {508, -540, 488, -367, 144, -24};
  const Six begin = {values[0], values[1], values[2], values[3], values[4], values[5]};
  Six end{};
  for (std::size_t i = 0; i < end.size(); ++i) end[i] = values[values.size() - 1 - i];
  std::vector<double> all = {dot(second, begin.data()) / 209, dot(first, begin.data()) / 209};
  all.insert(all.end(), values.begin(), values.end());
  all.push_back(dot(first, end.data()) / 209);
  all.push_back(dot(second, end.data()) / 209);
  return all;
}

/// Between the third and the fourth of six samples; t in 0..1. CIE 167:2005, equations 1 and 2.
double between(const double* six, double t) {
  static constexpr std::array<Six, 5> coefficients = {{{2, -16, 0, 16, -2, 0},
                                                       {-1, 16, -30, 16, -1, 0},
                                                       {-9, 39, -70, 66, -33, 7},
                                                       {13, -64, 126, -124, 61, -12},
                                                       {-5, 25, -50, 50, -25, 5}}};
  double sum = 0;
  for (std::size_t i = coefficients.size(); i-- > 0;) sum = t * (sum + dot(coefficients[i], six));
  return six[2] + sum / 24;
}

double step_of(const std::vector<double>& nm) {
  return (nm.back() - nm.front()) / static_cast<double>(nm.size() - 1);
}

}  // namespace

std::optional<std::string> sprague_fault(const Spectrum& samples) {
  const std::vector<double>& nm = samples.nm;
  if (nm.size() < 6)
    return "Sprague's interpolation takes 6 samples at least, not " + std::to_string(nm.size());
  const double own = step_of(nm);
  for (std::size_t i = 0; i < nm.size(); ++i)
    if (!(std::abs(nm[i] - nm.front() - static_cast<double>(i) * own) <= alike * own))
      return "Sprague's interpolation takes samples at even distances; " + number_text(nm[i]) +
             " nm is not at one";
  return std::nullopt;
}

Result<std::vector<double>> sprague(const Spectrum& samples, const std::vector<double>& nm) {
  if (auto fault = sprague_fault(samples)) return problem(std::move(*fault));
  const double own = step_of(samples.nm);
  const std::vector<double> all = extended(samples.values);
  std::vector<double> result;
  result.reserve(nm.size());
  for (const double x : nm) {
    assert(x >= samples.nm.front() && x <= samples.nm.back());
    const double place = (x - samples.nm.front()) / own, nearest = std::round(place);
    if (std::abs(place - nearest) <= alike) {
      result.push_back(samples.values[static_cast<std::size_t>(nearest)]);
      continue;
    }
    const double left = std::floor(place);
    result.push_back(between(&all[static_cast<std::size_t>(left)], place - left));
  }
  return result;
}

}  // namespace metamer
