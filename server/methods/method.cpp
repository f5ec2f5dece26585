#include "server/methods/method.h"

#include <algorithm>
#include <cassert>

#include "common/color/xyz.h"
#include "common/scene/settings.h"
#include "server/methods/exact.h"
#include "server/methods/fitted.h"
#include "server/methods/linear.h"
#include "server/methods/point.h"
#include "server/methods/prefilter.h"
#include "server/methods/rgb.h"

namespace metamer {

std::unique_ptr<Method> make_method(const v1::Plan& plan, const RenderScene& scene) {
  switch (plan.method().method_case()) {
    case v1::Method::kPoint:
      return plan.method().point().has_fitted() ? make_fitted(plan, scene)
                                                : make_point(plan, scene);
    case v1::Method::kRgb:
      return make_rgb(plan, scene);
    case v1::Method::kExact:
      return make_exact(plan, scene);
    case v1::Method::kLinear:
      return make_linear(plan, scene);
    case v1::Method::kPrefilter:
      return make_prefilter(plan, scene);
    case v1::Method::METHOD_NOT_SET:
      break;
  }
  assert(false && "a plan names its method");
  return nullptr;
}

Features method_features(const v1::Method& method) {
  switch (method.method_case()) {
    case v1::Method::kPoint:
    case v1::Method::kRgb:
    case v1::Method::kExact:
    case v1::Method::kLinear:
    case v1::Method::kPrefilter:
    case v1::Method::METHOD_NOT_SET:  // it is chosen later
      return Features::all();
  }
  return {};
}

Wavelengths method_wavelengths(const v1::Method& method) {
  const bool own = method.has_point() && !method.point().has_fitted();
  return own ? *point_wavelengths(method.point()) : observer_wavelengths();
}

std::size_t method_bands(const v1::Method& method) {
  if (method.has_linear()) return method.linear().bases();
  if (!method.has_point()) return 3;
  return method.point().has_fitted() ? method.point().fitted() : method_wavelengths(method).size();
}

void notice_dark_lights(const RenderScene& scene, const v1::Settings& settings,
                        const Wavelengths& wavelengths, v1::Plan& plan) {
  const ObserverWeights observer = observer_weights(to_observer(settings.observer()), wavelengths);
  for (const RenderLight& light : scene.lights) {
    const Spectrum& emission = scene.emissions[light.emission];
    const auto power = resample(emission, wavelengths.nm(), Outside::zero).values;
    if (luminance_scale(observer, power, light.luminance) > 0 || light.luminance == 0) continue;
    v1::Notice* notice = plan.add_notice();
    notice->set_field(scene.emission_fields[light.emission]);
    notice->set_message("light \"" + light.name +
                        "\" stays dark: the observer sees nothing of it at these wavelengths");
  }
}

}  // namespace metamer
