#include "common/scene/settings.h"

#include <cassert>

#include "common/scene/methods.h"

namespace metamer {

void take_older_goal(v1::Settings& settings) {
  const v1::Method& method = settings.method();
  const bool alone = method.method_case() == v1::Method::METHOD_NOT_SET && !settings.has_goal();
  if (!method.has_auto_() || !alone) return;
  *settings.mutable_goal() = method.auto_();
  settings.clear_method();
}

v1::Settings with_defaults(const v1::Settings& settings) {
  v1::Settings full = settings;
  if (!full.has_width()) full.set_width(640);
  if (!full.has_height()) full.set_height(480);
  if (!full.has_spp()) full.set_spp(16);
  if (!full.has_depth()) full.set_depth(4);
  if (!full.has_cutoff()) full.set_cutoff(1e-3);
  if (!full.has_light_samples()) full.set_light_samples(4);
  if (!full.has_bounces()) full.set_bounces(0);
  if (!full.has_bounce_samples()) full.set_bounce_samples(4);
  if (!full.has_tile_size()) full.set_tile_size(16);

  take_older_goal(full);
  if (full.has_goal() && full.goal().goal_case() == v1::Goal::GOAL_NOT_SET)
    full.mutable_goal()->set_tolerance(0.5);
  if (!full.has_goal() && full.method().method_case() == v1::Method::METHOD_NOT_SET)
    full.mutable_method()->mutable_exact();
  if (const MethodEntry* method = method_entry(full.method()); method && method->fill)
    method->fill(*full.mutable_method());
  return full;
}

Result<Wavelengths> point_wavelengths(const v1::Point& point) {
  if (!point.wavelengths().empty()) {
    return Wavelengths::listed({point.wavelengths().begin(), point.wavelengths().end()});
  }
  return Wavelengths::uniform(point.from(), point.to(), point.step());
}

const Observer& to_observer(v1::Observer observer) {
  switch (observer) {
    case v1::CIE_1931_2DEG:
      return cie::observer_1931();
    case v1::CIE_1964_10DEG:
      return cie::observer_1964();
    // protobuf's own two, which no message can hold.
    case v1::Observer_INT_MIN_SENTINEL_DO_NOT_USE_:
    case v1::Observer_INT_MAX_SENTINEL_DO_NOT_USE_:
      break;
  }
  assert(false && "validate_scene finds observers that do not exist");
  return cie::observer_1931();
}

}  // namespace metamer
