#include "common/color/sunlight.h"

#include <array>
#include <cmath>
#include <numbers>

#include "common/color/radiators.h"

namespace metamer {
namespace {

/// Their table 2, by 10 nm from `from_nm` on: W / (cm² µm sr) of the sun, and absorption per cm of
/// ozone, of mixed gases (oxygen's A band) and of water vapour.
constexpr double from_nm = 380, step_nm = 10;
constexpr std::array sun = {1655.9,  1623.37, 2112.75, 2588.82, 2582.91, 2423.23, 2676.05, 2965.83,
                            3054.54, 3005.75, 3066.37, 2883.04, 2871.21, 2782.5,  2710.06, 2723.36,
                            2636.13, 2550.38, 2506.02, 2531.16, 2535.59, 2513.42, 2463.15, 2417.32,
                            2368.53, 2321.21, 2282.77, 2233.98, 2197.02, 2152.67, 2109.79, 2072.83,
                            2024.04, 1987.08, 1942.72, 1907.24, 1862.89, 1825.92};

struct Absorption {
  double nm;  ///< Of the first value.
  std::array<double, 33> values;
  double at(double where) const {
    const double index = (where - nm) / step_nm;
    return index >= 0 && index < 33 ? values[static_cast<std::size_t>(index)] : 0;
  }
};
constexpr Absorption ozone = {
    450, {0.003, 0.006, 0.009, 0.014, 0.021, 0.030, 0.040, 0.048, 0.063, 0.075, 0.085,
          0.103, 0.120, 0.120, 0.115, 0.125, 0.120, 0.105, 0.090, 0.079, 0.067, 0.057,
          0.048, 0.036, 0.028, 0.023, 0.018, 0.014, 0.011, 0.010, 0.009, 0.007, 0.004}};
constexpr Absorption gases = {760, {3.0, 0.21}};
constexpr Absorption vapour = {690,
                               {0.016, 0.024, 0.0125, 1.0, 0.87, 0.061, 0.001, 1e-5, 1e-5, 6e-4}};

double sun_at(std::size_t index) {
  if (index < sun.size()) return sun[index];
  const double last = from_nm + step_nm * (sun.size() - 1);
  const Spectrum body = planckian(5778, {last, from_nm + step_nm * static_cast<double>(index)});
  return sun.back() * body.values[1] / body.values[0];
}

/// F. Kasten (1966): by how much of the atmosphere's height light comes through.
double air_mass(double elevation) {
  const double zenith = 90 - elevation;
  return 1 / (std::cos(zenith * std::numbers::pi / 180) + 0.15 * std::pow(93.885 - zenith, -1.253));
}

/// What is left of light after `mass` of the atmosphere.
double transmittance(double nm, double turbidity, double mass) {
  constexpr double ozone_cm = 0.35, vapour_cm = 2;
  const double um = nm / 1000;
  const double rayleigh = 0.008735 * std::pow(um, -4.08);
  const double aerosol = (0.04608 * turbidity - 0.04586) * std::pow(um, -1.3);  // Ångström's
  const double of_gases = gases.at(nm) * mass, of_vapour = vapour.at(nm) * vapour_cm * mass;
  return std::exp(-mass * (rayleigh + aerosol + ozone.at(nm) * ozone_cm) -
                  1.41 * of_gases / std::pow(1 + 118.93 * of_gases, 0.45) -
                  0.2385 * of_vapour / std::pow(1 + 20.07 * of_vapour, 0.45));
}

}  // namespace

Spectrum sunlight(double turbidity, double elevation) {
  const double mass = air_mass(elevation);
  Spectrum result;
  for (std::size_t i = 0; i <= 40; ++i) {
    result.nm.push_back(from_nm + step_nm * static_cast<double>(i));
    result.values.push_back(sun_at(i) * transmittance(result.nm.back(), turbidity, mass));
  }
  return result;
}

}  // namespace metamer
