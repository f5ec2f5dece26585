#include "server/plan/missed_light.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "common/scene/settings.h"

namespace metamer {
namespace {

/// Over the emission's own range; beyond, it is 0 from one step to the next.
double integral(const Spectrum& emission, const Spectrum& sensitivity) {
  std::vector<double> nm;
  std::merge(emission.nm.begin(), emission.nm.end(), sensitivity.nm.begin(), sensitivity.nm.end(),
             std::back_inserter(nm));
  const auto power = resample(emission, nm, Outside::zero).values;
  const auto seen = resample(sensitivity, nm, Outside::zero).values;
  double sum = 0;
  for (std::size_t i = 0; i + 1 < nm.size(); ++i) {
    if (nm[i] < emission.nm.front() || nm[i + 1] > emission.nm.back()) continue;
    sum +=  // of the product of two lines
        (nm[i + 1] - nm[i]) / 6 *
        (2 * power[i] * seen[i] + power[i] * seen[i + 1] + power[i + 1] * seen[i] +
         2 * power[i + 1] * seen[i + 1]);
  }
  return sum;
}

}  // namespace

double seen_share(const Spectrum& emission, cie::Observer observer,
                  const Wavelengths& wavelengths) {
  const double all = integral(emission, cie::matching_functions(observer)[1]);
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
}

}  // namespace metamer
