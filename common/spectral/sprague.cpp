#include "common/spectral/sprague.h"

#include <array>
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

}  // namespace

Result<Spectrum> sprague(const Spectrum& spectrum, double step) {
  const std::vector<double>& nm = spectrum.nm;
  if (nm.size() < 6)
    return problem("Sprague's interpolation takes 6 samples at least, not " +
                   std::to_string(nm.size()));
  const double own = (nm.back() - nm.front()) / static_cast<double>(nm.size() - 1);
  for (std::size_t i = 0; i < nm.size(); ++i)
    if (!(std::abs(nm[i] - nm.front() - static_cast<double>(i) * own) <= alike * own))
      return problem("Sprague's interpolation takes samples at even distances; " +
                     number_text(nm[i]) + " nm is not at one");
  auto positions = Wavelengths::uniform(nm.front(), nm.back(), step);
  if (!positions) return tl::unexpected(std::move(positions.error()));

  const std::vector<double> samples = extended(spectrum.values);
  Spectrum result{positions->nm(), {}};
  for (const double x : result.nm) {
    const double place = (x - nm.front()) / own, nearest = std::round(place);
    if (std::abs(place - nearest) <= alike) {
      result.values.push_back(spectrum.values[static_cast<std::size_t>(nearest)]);
      continue;
    }
    const double left = std::floor(place);
    result.values.push_back(between(&samples[static_cast<std::size_t>(left)], place - left));
  }
  return result;
}

}  // namespace metamer
