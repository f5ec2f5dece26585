#include "client/tools/spectra/spectrum_facts.h"

#include <algorithm>

#include "common/color/xyz.h"

namespace metamer::client {
namespace {

EmissionFacts emission_facts(const Spectrum& light, const Observer& own) {
  std::vector<Observer> observers = {cie::observer_1931(), cie::observer_1964()};
  if (own.name() != observers[0].name() && own.name() != observers[1].name())
    observers.push_back(own);
  EmissionFacts facts;
  for (const Observer& observer : observers) {
    const Xyz xyz = emission_xyz(light, observer);
    facts.observed.push_back({observer, xyz[1], chromaticity(xyz)});
  }
  if (const auto two_degrees = facts.observed[0].chromaticity)
    facts.temperature = color_temperature(*two_degrees);
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
                                     const Observer& observer, TableWeights weights) {
  const Spectrum& samples = one.samples;
  const auto [least, most] = std::minmax_element(samples.values.begin(), samples.values.end());
  SpectrumFacts facts{samples.nm.front(), samples.nm.back(), samples.nm.size(), *least, *most, {}};
  if (one.emission()) {
    facts.look = emission_facts(one.spectrum(), observer);
    return facts;
  }
  const Spectrum& spectrum = one.seen_by(weights);
  return weights_under(weights, observer, light, spectrum.nm).map([&](const ObserverWeights& lit) {
    facts.look = reflectance_facts(spectrum, lit);
    return facts;
  });
}

}  // namespace metamer::client
