#include "client/tools/spectra/spectrum_rgb.h"

#include "common/color/matrix3.h"
#include "common/scene/development.h"

namespace metamer::client {
namespace {

/// X Y Z of a light of luminance 1, or of a reflectance under it.
Result<Xyz> tristimulus(const LoadedSpectrum& one, const Spectrum& light, const Observer& observer,
                        TableWeights weights) {
  if (one.emission()) return white_of(light, observer);
  const Spectrum& spectrum = one.seen_by(weights);
  return weights_under(weights, observer, light, spectrum.nm).map([&](const ObserverWeights& lit) {
    return to_xyz(lit, spectrum.values);
  });
}

/// What turns X Y Z under this light into RGB: the plan of a picture lit by it alone.
Result<PlannedDevelopment> developing_under(const Xyz& white, const v1::Development& development) {
  v1::Plan plan;
  *plan.mutable_development() = development;
  if (white[1] > 0) plan.mutable_source_white()->Add(white.begin(), white.end());
  return planned_development(plan);
}

}  // namespace

Result<SpectrumRgb> spectrum_rgb(const LoadedSpectrum& one, const Spectrum& light,
                                 const Observer& observer, double luminance,
                                 const v1::Development& development, TableWeights weights) {
  const Spectrum& shining = one.emission() ? one.spectrum() : light;
  const Xyz white = white_of(shining, observer);
  auto planned = developing_under(white, development);
  if (!planned) return tl::unexpected(std::move(planned.error()));

  SpectrumRgb result;
  result.dark = !(white[1] > 0);
  const auto xyz = tristimulus(one, shining, observer, weights);
  if (!xyz) return tl::unexpected<Problem>(xyz.error());
  result.xyz = *xyz;
  for (double& value : result.xyz) value *= luminance;
  result.linear = multiply(multiply(planned->space.from_xyz, planned->adaptation), result.xyz);
  result.encoded = result.linear;
  if (!development.linear())
    for (double& value : result.encoded) value = encode(planned->space.transfer, value);
  result.in_gamut = true;
  for (const double value : result.linear)
    result.in_gamut = result.in_gamut && value >= -1e-9 && value <= 1 + 1e-9;
  result.space = std::move(planned->space);
  result.unadapted = std::move(planned->unadapted);
  result.shown_white = std::move(planned->shown_white);
  return result;
}

}  // namespace metamer::client
