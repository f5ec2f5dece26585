#include "common/color/rendering_index.h"

#include <algorithm>
#include <cmath>

#include "common/color/chromaticity.h"
#include "common/color/radiators.h"

namespace metamer {
namespace {

constexpr double hottest = 25000;  // Beyond, the CIE defines no daylight.
constexpr double coldest_daylight = 5000;

/// The CIE's tables are those of 5 nm; a light that somebody measured finer may have narrow lines.
Wavelengths positions_for(const Spectrum& light) {
  const bool coarse = std::all_of(light.nm.begin(), light.nm.end(),
                                  [](double nm) { return std::fmod(nm, 5) == 0; });
  return *Wavelengths::uniform(380, 780, coarse ? 5 : 1);
}

/// CIE 1964 U*V*W*, in which these indices are defined.
struct Uvw {
  double u, v, w;
};

/// The test colours as they look under one light.
struct Samples {
  Uv white;
  std::array<Uv, 15> uv;
  std::array<double, 15> luminance;  ///< Of 100.
};

Samples look(const ObserverWeights& observer, const Wavelengths& wavelengths,
             const std::vector<double>& light) {
  const Xyz white = to_xyz(observer, light);
  Samples result{.white = uv_1960(*chromaticity(white)), .uv = {}, .luminance = {}};
  for (std::size_t i = 0; i < result.uv.size(); ++i) {
    const Spectrum& paint = *cie::test_color(cie::test_color_names()[i]);
    std::vector<double> power = resample(paint, wavelengths.nm(), Outside::hold).values;
    for (std::size_t k = 0; k < power.size(); ++k) power[k] *= light[k];
    const Xyz xyz = to_xyz(observer, power);
    result.luminance[i] = 100 * xyz[1] / white[1];
    result.uv[i] = uv_1960(*chromaticity(xyz));
  }
  return result;
}

/// The c and d of von Kries's transform in u, v: CIE 13.3, equation 5.
double c_of(const Uv& uv) { return (4 - uv.u - 10 * uv.v) / uv.v; }
double d_of(const Uv& uv) { return (1.708 * uv.v + 0.404 - 1.481 * uv.u) / uv.v; }

/// What looks under `from` like `uv` is there under `to`.
Uv adapt(const Uv& uv, const Uv& from, const Uv& to) {
  const double c = c_of(to) / c_of(from) * c_of(uv), d = d_of(to) / d_of(from) * d_of(uv);
  const double share = 16.518 + 1.481 * c - d;
  return {(10.872 + 0.404 * c - 4 * d) / share, 5.520 / share};
}

Uvw to_uvw(double luminance, const Uv& uv, const Uv& white) {
  const double w = 25 * std::cbrt(luminance) - 17;
  return {13 * w * (uv.u - white.u), 13 * w * (uv.v - white.v), w};
}

}  // namespace

Result<RenderingIndex> rendering_index(const Spectrum& light) {
  const Wavelengths wavelengths = positions_for(light);
  const ObserverWeights observer = observer_weights(cie::Observer::cie_1931_2deg, wavelengths);
  std::vector<double> power = resample(light, wavelengths.nm(), Outside::zero).values;
  const auto [least, most] = std::minmax_element(power.begin(), power.end());
  if (*least < 0) return problem("a light has no power below 0");
  if (const double largest = *most; largest > 0)
    for (double& value : power) value /= largest;
  const auto own = chromaticity(to_xyz(observer, power));
  if (!own) return problem("a light that nobody sees renders no colours");

  // Find the reference of its temperature.
  const auto temperature = color_temperature(*own);
  if (!temperature || temperature->kelvin > hottest)
    return problem("no black body or daylight of 1000 to 25000 K is like this light");
  const double kelvin = temperature->kelvin;
  const Spectrum reference = kelvin < coldest_daylight ? planckian(kelvin, wavelengths.nm())
                                                       : daylight(kelvin, wavelengths.nm());

  // Compare the test colours, adapted to the reference.
  const Samples here = look(observer, wavelengths, power);
  const Samples there = look(observer, wavelengths, reference.values);
  RenderingIndex result{.ra = 0, .each = {}, .kelvin = kelvin, .distance = 0};
  result.distance = std::hypot(here.white.u - there.white.u, here.white.v - there.white.v);
  for (std::size_t i = 0; i < result.each.size(); ++i) {
    const Uvw one =
        to_uvw(here.luminance[i], adapt(here.uv[i], here.white, there.white), there.white);
    const Uvw other = to_uvw(there.luminance[i], there.uv[i], there.white);
    result.each[i] = 100 - 4.6 * std::hypot(one.u - other.u, one.v - other.v, one.w - other.w);
    if (i < 8) result.ra += result.each[i] / 8;
  }
  return result;
}

}  // namespace metamer
