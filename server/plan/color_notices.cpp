#include "server/plan/color_notices.h"

#include <algorithm>

#include "common/color/lab.h"
#include "common/color/xyz.h"
#include "common/scene/methods.h"
#include "server/methods/direct_errors.h"

namespace metamer {
namespace {

constexpr double unnoticed_share = 0.01;

std::string formatted(const char* format, auto... values) {
  char text[320];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

void add(const std::string& field, const std::string& message, v1::Plan& plan) {
  v1::Notice* notice = plan.add_notice();
  notice->set_field(field);
  notice->set_message(message);
}

/// How much of a light is seen up to a wavelength: X + Y + Z.
class Seen {
 public:
  Seen(const RenderLight& light, const Spectrum& emission, const Observer& observer)
      : light_(&light) {
    const Wavelengths cells = cells_of(with_observer(observer, {&emission}));
    const ObserverWeights eye = observer_weights(observer, cells);
    const std::vector<double> power = resample(emission, cells.nm(), Outside::zero).values;
    nm_ = cells.nm();
    below_.assign(1, 0.0);
    for (std::size_t i = 0; i < power.size(); ++i)
      below_.push_back(below_.back() +
                       power[i] * (eye.weights[0][i] + eye.weights[1][i] + eye.weights[2][i]));
  }
  const RenderLight& light() const { return *light_; }
  bool any() const { return below_.back() > 0; }
  double share_outside(double from, double to) const {
    return 1 - (below(to) - below(from)) / below_.back();
  }

 private:
  double below(double nm) const {
    return below_[static_cast<std::size_t>(std::lower_bound(nm_.begin(), nm_.end(), nm) -
                                           nm_.begin())];
  }
  const RenderLight* light_;
  std::vector<double> nm_, below_;
};

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

void notice_emission(const Spectrum& emission, const std::string& field, const Observer& observer,
                     v1::Plan& plan) {
  const Xyz own = white_of(emission, observer), other = white_of(continued(emission), observer);
  if (!(own[1] > 0)) return;
  const Xyz white = usable_white(own);
  const double de00 = delta_e_00(to_lab(own, white), to_lab(other, white));
  if (!(de00 > unnoticed_difference)) return;
  add(field,
      formatted(
          "its data end at %g and %g nm, where it still has power: 0 beyond; its white would be "
          "ΔE00 %.2g another if it went on",
          emission.nm.front(), emission.nm.back(), de00),
      plan);
}

void notice_property(const Spectrum& property, const std::string& field,
                     const std::vector<Seen>& lights, v1::Plan& plan) {
  double share = 0;
  const RenderLight* worst = nullptr;
  for (const Seen& seen : lights) {
    const double outside = seen.share_outside(property.nm.front(), property.nm.back());
    if (!(outside > share)) continue;
    share = outside;
    worst = &seen.light();
  }
  if (!(share > unnoticed_share)) return;
  add(field,
      formatted(
          "its data end at %g and %g nm: %.2g %% of what is seen of light \"%s\" lies beyond, "
          "where it keeps its end values",
          property.nm.front(), property.nm.back(), 100 * share, worst->name.c_str()),
      plan);
}

}  // namespace

void notice_colors(const RenderScene& scene, const Method& method, v1::Plan& plan) {
  const std::string name = method_text(plan.method());
  for (const LightError& error : DirectColors(scene, scene.observer).errors(method)) {
    const RenderLight& light = scene.lights[error.light];
    const std::string& field = scene.emission_fields[light.emission];
    const std::string named = "light \"" + light.name + "\"";
    if (!error.seen || error.dark) {
      add(field,
          named + " stays dark: the observer sees nothing of it" +
              (error.seen ? " at these wavelengths" : ""),
          plan);
      continue;
    }
    if (!(std::max(error.white, error.material) > unnoticed_difference)) continue;
    std::string text = "by " + name + ", ";
    if (error.white > unnoticed_difference)
      text += formatted("the white of %s is ΔE00 %.2g off", named.c_str(), error.white);
    if (error.material > unnoticed_difference)
      text += formatted(error.white > unnoticed_difference ? ", \"%s\" under it %.2g"
                                                           : "\"%s\" is ΔE00 %.2g off under %s",
                        scene.materials[error.worst].name.c_str(), error.material, named.c_str());
    add(field, text + "; method exact is not", plan);
  }
}

void notice_ends_of_data(const RenderScene& scene, v1::Plan& plan) {
  const Observer& observer = scene.observer;
  for (std::size_t i = 0; i < scene.emissions.size(); ++i)
    notice_emission(scene.emissions[i], scene.emission_fields[i], observer, plan);
  std::vector<Seen> lights;
  for (const RenderLight& light : scene.lights) {
    Seen seen(light, scene.emissions[light.emission], observer);
    if (seen.any()) lights.push_back(std::move(seen));
  }
  for (std::size_t i = 0; i < scene.properties.size(); ++i)
    notice_property(scene.properties[i], scene.property_fields[i], lights, plan);
  for (std::size_t i = 0; i < scene.constants.size(); ++i)
    notice_property(scene.constants[i].n, scene.constants_fields[i], lights, plan);
}

}  // namespace metamer
