#include "server/methods/method.h"

#include <cassert>
#include <cstring>

#include "common/scene/methods.h"
#include "server/methods/exact.h"
#include "server/methods/linear.h"
#include "server/methods/point.h"
#include "server/methods/prefilter.h"
#include "server/methods/rgb.h"

namespace metamer {

const std::vector<MethodArithmetic>& method_arithmetic() {
  static const std::vector<MethodArithmetic> all = {
      {.word = "point",
       .make = make_point,
       .plan = plan_point,
       .wavelengths = wavelengths_of_point,
       .features = Features::all()},
      {.word = "linear", .make = make_linear, .plan = plan_linear},
      {.word = "exact", .make = make_exact, .plan = plan_exact},
      {.word = "prefilter", .make = make_prefilter, .plan = plan_prefilter},
      {.word = "rgb", .make = make_rgb}};
  return all;
}

namespace {

/// Null where no method is set.
const MethodArithmetic* arithmetic_of(const v1::Method& method) {
  const MethodEntry* entry = method_entry(method);
  if (entry == nullptr) return nullptr;
  for (const MethodArithmetic& one : method_arithmetic())
    if (std::strcmp(one.word, entry->word) == 0) return &one;
  assert(false && "a test holds both tables against each other");
  return nullptr;
}

}  // namespace

std::unique_ptr<Method> make_method(const v1::Plan& plan, const RenderScene& scene) {
  const MethodArithmetic* arithmetic = arithmetic_of(plan.method());
  assert(arithmetic != nullptr && "a plan names its method");
  return arithmetic->make(plan, scene);
}

Features method_features(const v1::Method& method) {
  const MethodArithmetic* arithmetic = arithmetic_of(method);
  return arithmetic != nullptr ? arithmetic->features : carried_features;
}

Wavelengths method_wavelengths(const v1::Method& method) {
  const MethodArithmetic* arithmetic = arithmetic_of(method);
  return arithmetic != nullptr && arithmetic->wavelengths ? arithmetic->wavelengths(method)
                                                          : observer_wavelengths();
}

void plan_method(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan) {
  const Wavelengths wavelengths = method_wavelengths(settings.method());
  plan.set_from(wavelengths.nm().front());
  plan.set_to(wavelengths.nm().back());
  plan.set_bands(3);
  const MethodArithmetic* arithmetic = arithmetic_of(settings.method());
  if (arithmetic != nullptr && arithmetic->plan) arithmetic->plan(scene, settings, plan);
}

}  // namespace metamer
