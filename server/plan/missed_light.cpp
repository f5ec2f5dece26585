#include "server/plan/missed_light.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/scene/settings.h"

namespace metamer {
namespace {

/// Σ of the exact products of the straight pieces. An emission is 0 beyond its own range, from one
/// step to the next; a property keeps its end values.
double integral(const Spectrum& spectrum, const Spectrum& sensitivity, Outside outside) {
  std::vector<double> nm;
  std::merge(spectrum.nm.begin(), spectrum.nm.end(), sensitivity.nm.begin(), sensitivity.nm.end(),
             std::back_inserter(nm));
  const auto power = resample(spectrum, nm, outside).values;
  const auto seen = resample(sensitivity, nm, Outside::zero).values;
  double sum = 0;
  for (std::size_t i = 0; i + 1 < nm.size(); ++i) {
    if (outside == Outside::zero && (nm[i] < spectrum.nm.front() || nm[i + 1] > spectrum.nm.back()))
      continue;
    sum +=  // of the product of two lines
        (nm[i + 1] - nm[i]) / 6 *
        (2 * power[i] * seen[i] + power[i] * seen[i + 1] + power[i + 1] * seen[i] +
         2 * power[i + 1] * seen[i + 1]);
  }
  return sum;
}

/// What a property reflects of equal energy, as luminance: truly, and by the samples.
struct Reflected {
  double truly, sampled;
};
Reflected reflected(const Spectrum& property, cie::Observer observer,
                    const Wavelengths& wavelengths) {
  const Spectrum& sensitivity = cie::matching_functions(observer)[1];
  const Spectrum white{{560}, {1}};
  const ObserverWeights weights = observer_weights(observer, wavelengths);
  const auto samples = resample(property, wavelengths.nm(), Outside::hold).values;
  const std::vector<double> ones(wavelengths.size(), 1);
  return {
      integral(property, sensitivity, Outside::hold) / integral(white, sensitivity, Outside::hold),
      to_xyz(weights, samples)[1] / to_xyz(weights, ones)[1]};
}

void notice_missed_reflectance(const RenderScene& scene, cie::Observer observer,
                               const Wavelengths& wavelengths, v1::Plan& plan) {
  constexpr double unnoticed = 0.1;  // of it: a coarse sampling of a paint is off by a few percent
  for (std::size_t i = 0; i < scene.properties.size(); ++i) {
    const auto [truly, sampled] = reflected(scene.properties[i], observer, wavelengths);
    if (!std::isfinite(sampled) || std::abs(sampled - truly) <= unnoticed * truly) continue;
    char text[160];
    std::snprintf(
        text, sizeof text,
        "it reflects %.3g %% of the luminance of equal energy; %zu wavelength%s see%s %.3g %%",
        100 * truly, wavelengths.size(), wavelengths.size() == 1 ? "" : "s",
        wavelengths.size() == 1 ? "s" : "", 100 * sampled);
    v1::Notice* notice = plan.add_notice();
    notice->set_field(scene.property_fields[i]);
    notice->set_message(text);
  }
}

}  // namespace

double seen_share(const Spectrum& emission, cie::Observer observer,
                  const Wavelengths& wavelengths) {
  const double all = integral(emission, cie::matching_functions(observer)[1], Outside::zero);
  if (!(all > 0 && std::isfinite(all))) return 1;
  const auto power = resample(emission, wavelengths.nm(), Outside::zero).values;
  return to_xyz(observer_weights(observer, wavelengths), power)[1] / all;
}

void notice_missed_light(const RenderScene& scene, const v1::Settings& settings,
                         const Wavelengths& wavelengths, v1::Plan& plan) {
  constexpr double unnoticed = 0.02;
  for (std::size_t i = 0; i < scene.emissions.size(); ++i) {
    const double share =
        seen_share(scene.emissions[i], to_observer(settings.observer()), wavelengths);
    if (std::abs(share - 1) <= unnoticed) continue;
    char text[160];
    const char* const many = wavelengths.size() == 1 ? "" : "s";
    if (share < 1)
      std::snprintf(text, sizeof text, "%zu wavelength%s miss%s %.0f %% of its luminance",
                    wavelengths.size(), many, *many ? "" : "es", 100 * (1 - share));
    else
      std::snprintf(text, sizeof text, "%zu wavelength%s see%s %.3g times its luminance",
                    wavelengths.size(), many, *many ? "" : "s", share);
    v1::Notice* notice = plan.add_notice();
    notice->set_field(scene.emission_fields[i]);
    notice->set_message(text);
  }
  notice_missed_reflectance(scene, to_observer(settings.observer()), wavelengths, plan);
}

}  // namespace metamer
