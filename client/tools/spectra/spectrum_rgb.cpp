#include "client/tools/spectra/spectrum_rgb.h"

#include "client/tools/spectra/summation.h"
#include "common/color/matrix3.h"
#include "common/scene/development.h"

namespace metamer::client {
namespace {

/// X Y Z of a light of this luminance, or of a reflectance under it.
Xyz tristimulus(const LoadedSpectrum& one, std::vector<double> power,
                const Wavelengths& wavelengths, const ObserverWeights& observer, double luminance) {
  const double scale = luminance_scale(observer, power, luminance);
  if (!one.emission) {
    const auto reflected = resample(one.spectrum, wavelengths.nm(), Outside::hold).values;
    for (std::size_t i = 0; i < power.size(); ++i) power[i] *= reflected[i];
  }
  const Xyz xyz = to_xyz(observer, power);
  return {scale * xyz[0], scale * xyz[1], scale * xyz[2]};
}

/// What turns X Y Z under this light into RGB: the plan of a picture lit by it alone.
Result<PlannedDevelopment> developing_under(const Xyz& white, const v1::Development& development) {
  v1::Plan plan;
  *plan.mutable_development() = development;
  for (const double value : white)
    if (white[1] > 0) plan.add_source_white(value / white[1]);
  return planned_development(plan);
}

}  // namespace

Result<SpectrumRgb> spectrum_rgb(const LoadedSpectrum& one, const Spectrum& light,
                                 cie::Observer observer, double luminance,
                                 const v1::Development& development) {
  const Spectrum& shining = one.emission ? one.spectrum : light;
  const Wavelengths wavelengths = fine_wavelengths(shining);
  const ObserverWeights eye = observer_weights(observer, wavelengths);
  const std::vector<double> power = resample(shining, wavelengths.nm(), Outside::zero).values;
  const Xyz white = to_xyz(eye, power);
  auto planned = developing_under(white, development);
  if (!planned) return tl::unexpected(std::move(planned.error()));

  SpectrumRgb result;
  result.dark = !(white[1] > 0);
  result.xyz = tristimulus(one, power, wavelengths, eye, luminance);
  result.linear = multiply(multiply(planned->space.from_xyz, planned->adaptation), result.xyz);
  result.encoded = result.linear;
  if (!development.linear())
    for (double& value : result.encoded) value = encode(planned->space.transfer, value);
  result.in_gamut = true;
  for (const double value : result.linear)
    result.in_gamut = result.in_gamut && value >= -1e-9 && value <= 1 + 1e-9;
  result.space = std::move(planned->space);
  result.unadapted = std::move(planned->unadapted);
  return result;
}

}  // namespace metamer::client
