#include "client/tools/spectra/spectrum_facts.h"

#include <algorithm>

#include "common/color/xyz.h"

namespace metamer::client {
namespace {

EmissionFacts emission_facts(const Spectrum& light) {
  const auto observed = [&](cie::Observer observer) {
    const Xyz xyz = emission_xyz(light, observer);
    return ObservedLight{observer, xyz[1], chromaticity(xyz)};
  };
  EmissionFacts facts{
      {observed(cie::Observer::cie_1931_2deg), observed(cie::Observer::cie_1964_10deg)}, {}, {}};
  if (const auto own = facts.observed[0].chromaticity) facts.temperature = color_temperature(*own);
  if (const auto index = rendering_index(light)) facts.rendering = *index;
  return facts;
}

ReflectanceFacts reflectance_facts(const Spectrum& reflectance, const ObserverWeights& lit) {
  const Xyz white = to_xyz(lit, std::vector<double>(reflectance.nm.size(), 1.0));
  const Xyz xyz = to_xyz(lit, reflectance.values);
  ReflectanceFacts facts{xyz[1], chromaticity(xyz), {}};
  if (*std::min_element(white.begin(), white.end()) > 0) facts.lab = to_lab(xyz, white);
  return facts;
}

}  // namespace

Result<SpectrumFacts> spectrum_facts(const LoadedSpectrum& one, const Spectrum& light,
                                     cie::Observer observer, TableWeights weights) {
  const Spectrum& spectrum = one.spectrum;
  const auto [least, most] = std::minmax_element(spectrum.values.begin(), spectrum.values.end());
  SpectrumFacts facts{
      spectrum.nm.front(), spectrum.nm.back(), spectrum.nm.size(), *least, *most, {}};
  if (one.emission) {
    facts.look = emission_facts(spectrum);
    return facts;
  }
  return weights_under(weights, observer, light, spectrum.nm).map([&](const ObserverWeights& lit) {
    facts.look = reflectance_facts(spectrum, lit);
    return facts;
  });
}

}  // namespace metamer::client
