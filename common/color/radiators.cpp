#include "common/color/radiators.h"

#include <array>
#include <cassert>
#include <cmath>

#include "common/spectral/cie.h"

namespace metamer {

Spectrum planckian(double kelvin, std::vector<double> nm) {
  constexpr double c2 = 1.4388e7;  // nm·K
  const auto power = [&](double at) {
    return std::pow(at / 560, -5) / std::expm1(c2 / (at * kelvin));
  };
  Spectrum result{.nm = std::move(nm), .values = {}};
  const double at_560 = power(560);
  for (const double at : result.nm) result.values.push_back(power(at) / at_560);
  return result;
}

namespace {

/// How much of each component gives a chromaticity, up to a factor.
std::array<double, 3> components_of(double x, double y) {
  return {0.0241 + 0.2562 * x - 0.7341 * y, -1.3515 - 1.7703 * x + 5.9114 * y,
          0.0300 - 31.4424 * x + 30.0717 * y};
}

}  // namespace

Spectrum daylight(double kelvin, std::vector<double> nm) {
  assert(kelvin >= 4000 && kelvin <= 25000);
  // Its chromaticity, of correlated colour temperature kelvin.
  const double r = 1000 / kelvin;
  const double x = kelvin <= 7000 ? ((-4.6070 * r + 2.9678) * r + 0.09911) * r + 0.244063
                                  : ((-2.0064 * r + 1.9018) * r + 0.24748) * r + 0.237040;
  const double y = (-3.000 * x + 2.870) * x - 0.275;

  const auto [first, second, third] = components_of(x, y);
  const double m1 = second / first, m2 = third / first;
  const auto& basis = cie::daylight_components();
  const auto at = [&](const std::vector<double>& where) {
    std::vector<double> sum = resample(basis[0], where, Outside::zero).values;
    const auto s1 = resample(basis[1], where, Outside::zero).values;
    const auto s2 = resample(basis[2], where, Outside::zero).values;
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += m1 * s1[i] + m2 * s2[i];
    return sum;
  };
  Spectrum result{.nm = std::move(nm), .values = {}};
  result.values = at(result.nm);
  const double at_560 = at({560}).front();
  for (double& value : result.values) value /= at_560;
  return result;
}

Spectrum daylight_of(double x, double y) {
  const auto& basis = cie::daylight_components();
  const auto shares = components_of(x, y);
  Spectrum sum = basis[0];
  for (std::size_t i = 0; i < sum.nm.size(); ++i) {
    sum.values[i] = 0;
    for (std::size_t part = 0; part < 3; ++part)
      sum.values[i] -= shares[part] * basis[part].values[i];  // the first is below 0
  }
  return sum;
}

}  // namespace metamer
