#include "common/color/ends_of_data.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "common/color/lab.h"
#include "common/color/usable_white.h"
#include "common/color/xyz.h"
#include "common/spectral/lines.h"
#include "common/spectral/wavelengths.h"

namespace metamer {
namespace {

constexpr double unnoticed_de00 = 0.3, unnoticed_share = 0.01, unnoticed_end = 0.02;

/// "its data end at 450 and 650 nm"
std::string ends_of(const Spectrum& data) {
  return "its data end at " + number_text(data.nm.front()) + " and " + number_text(data.nm.back()) +
         " nm";
}

std::string two_digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value < 10 ? "%.2g" : "%.0f", value);
  return text;
}

/// The emission as if it went on as it ends.
Spectrum continued(Spectrum emission) {
  for (const double nm : {observer_from_nm, observer_to_nm}) {
    const bool below = nm < emission.nm.front();
    if (!below && !(nm > emission.nm.back())) continue;
    emission.nm.insert(below ? emission.nm.begin() : emission.nm.end(), nm);
    emission.values.insert(below ? emission.values.begin() : emission.values.end(),
                           below ? emission.values.front() : emission.values.back());
  }
  return emission;
}

}  // namespace

CumulativeLight::CumulativeLight(std::string name, const Spectrum& emission,
                                 const Observer& observer)
    : name_(std::move(name)) {
  const Spectrum light = as_emission(emission);
  const Wavelengths cells = cells_of(with_observer(observer, {&light}));
  const ObserverWeights eye = observer_weights(observer, cells);
  const std::vector<double> power = resample(light, cells.nm(), Outside::zero).values;
  nm_ = cells.nm();
  below_.assign(1, 0.0);
  for (std::size_t i = 0; i < power.size(); ++i)
    below_.push_back(below_.back() +
                     power[i] * (eye.weights[0][i] + eye.weights[1][i] + eye.weights[2][i]));
}

double CumulativeLight::below(double nm) const {
  return below_[static_cast<std::size_t>(std::lower_bound(nm_.begin(), nm_.end(), nm) -
                                         nm_.begin())];
}

double CumulativeLight::share_outside(double from, double to) const {
  return 1 - (below(to) - below(from)) / below_.back();
}

std::string ends_of_light(const Spectrum& emission, const Observer& observer) {
  if (emission.nm.size() == 1) return {};
  const Xyz own = white_of(emission, observer), other = white_of(continued(emission), observer);
  if (!(own[1] > 0)) return {};
  const Xyz white = usable_white(own);
  const double de00 = delta_e_00(to_lab(own, white), to_lab(other, white));
  if (!(de00 > unnoticed_de00)) return {};
  return ends_of(emission) + ", where it still has power: 0 beyond; its white would be ΔE00 " +
         two_digits(de00) + " another if it went on";
}

std::string ends_of_property(const Spectrum& property, const std::vector<CumulativeLight>& lights) {
  double share = 0;
  const CumulativeLight* worst = nullptr;
  for (const CumulativeLight& light : lights) {
    if (!light.any()) continue;
    const double outside = light.share_outside(property.nm.front(), property.nm.back());
    if (!(outside > share)) continue;
    share = outside;
    worst = &light;
  }
  if (!(share > unnoticed_share)) return {};
  return ends_of(property) + ": " + two_digits(100 * share) + " % of what is seen of light " +
         quoted(worst->name()) + " lies beyond, where it keeps its end values";
}

std::string ends_of_observer(const Observer& observer) {
  double share = 0;
  const Spectrum* cut = nullptr;
  for (const Spectrum& function : observer.functions()) {
    const double most = *std::max_element(function.values.begin(), function.values.end());
    for (const auto& [nm, value] : {std::pair{function.nm.front(), function.values.front()},
                                    {function.nm.back(), function.values.back()}}) {
      if (nm <= observer_from_nm || nm >= observer_to_nm || !(value > share * most)) continue;
      share = value / most;
      cut = &function;
    }
  }
  if (!(share > unnoticed_end)) return {};
  return ends_of(*cut) + ", where it still sees " + two_digits(100 * share) +
         " % of its most: nothing beyond";
}

}  // namespace metamer
