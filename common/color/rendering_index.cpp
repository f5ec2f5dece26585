#include "common/color/rendering_index.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "common/color/chromaticity.h"
#include "common/color/radiators.h"
#include "common/spectral/lines.h"

namespace metamer {
namespace {

constexpr double hottest = 25000;  // Beyond, the CIE defines no daylight.
constexpr double coldest_daylight = 5000;

/// Those of the CIE's tables of test colours, every 5 nm.
const std::vector<double>& table_nm() { return cie::test_color(cie::test_color_names()[0])->nm; }

/// CIE 13.3 sums over tables by 5 nm, and F8's Ra of 95.45 is such a sum (the integral over
/// straight lines gives 95.53). A light that has other samples may have narrow lines.
bool has_the_tables_samples(const Spectrum& light) {
  return light.nm.size() > 1 && std::all_of(light.nm.begin(), light.nm.end(),
                                            [](double nm) { return std::fmod(nm, 5) == 0; });
}

/// The observer of the test colours under a light, of which a perfect white has luminance 1.
ObserverWeights lit_by(const Spectrum& light, bool summed) {
  const Observer& observer = cie::observer_1931();
  if (!summed) return under_light(observer, light, table_nm());
  ObserverWeights lit = observer_weights(observer, *Wavelengths::listed(table_nm()));
  const std::vector<double> power = resample(light, table_nm(), Outside::zero).values;
  const double scale = luminance_scale(lit, power, 1);
  for (std::vector<double>& weights : lit.weights)
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] *= scale * power[i];
  return lit;
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

Samples look(const ObserverWeights& lit, const Chromaticity& white) {
  Samples result{.white = uv_1960(white), .uv = {}, .luminance = {}};
  for (std::size_t i = 0; i < result.uv.size(); ++i) {
    const Spectrum& paint = *cie::test_color(cie::test_color_names()[i]);
    assert(paint.nm == table_nm());
    const Xyz xyz = to_xyz(lit, paint.values);
    result.luminance[i] = 100 * xyz[1];
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
  Spectrum own_light = as_emission(light);
  const auto [least, most] = std::minmax_element(own_light.values.begin(), own_light.values.end());
  if (*least < 0) return problem("a light has no power below 0");
  if (const double largest = *most; largest > 0)
    for (double& value : own_light.values) value /= largest;
  const bool summed = has_the_tables_samples(light);
  const ObserverWeights lit = lit_by(own_light, summed);
  const std::vector<double> perfect(table_nm().size(), 1.0);
  const auto own = chromaticity(to_xyz(lit, perfect));
  if (!own) return problem("a light that nobody sees renders no colours");

  // Find the reference of its temperature.
  const auto temperature = color_temperature(*own);
  if (!temperature || temperature->kelvin > hottest)
    return problem("no black body or daylight of 1000 to 25000 K is like this light");
  const double kelvin = temperature->kelvin;
  const Spectrum reference = kelvin < coldest_daylight
                                 ? planckian(kelvin, observer_wavelengths().nm())
                                 : daylight(kelvin, observer_wavelengths().nm());

  // Compare the test colours, adapted to the reference.
  const ObserverWeights lit_by_reference = lit_by(reference, summed);
  const Samples here = look(lit, *own);
  const Samples there = look(lit_by_reference, *chromaticity(to_xyz(lit_by_reference, perfect)));
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
