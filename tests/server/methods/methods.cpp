#include "tests/server/methods/methods.h"

#include "common/scene/methods.h"

namespace metamer::test {

v1::Method uniform(double from, double to, double step) {
  v1::Method method;
  method.mutable_point()->set_from(from);
  method.mutable_point()->set_to(to);
  method.mutable_point()->set_step(step);
  method.mutable_point()->set_lights(v1::Point::SAMPLES);
  return method;
}

v1::Method cells(double from, double to, double step) {
  v1::Method method = uniform(from, to, step);
  method.mutable_point()->set_lights(v1::Point::CELLS);
  return method;
}

v1::Method fitted(std::uint32_t count) {
  v1::Method method;
  method.mutable_point()->set_fitted(count);
  return method;
}

v1::Method linear(std::uint32_t bases, v1::Linear::Weighting weighting, bool bounce) {
  v1::Method method;
  method.mutable_linear()->set_bases(bases);
  method.mutable_linear()->set_weighting(weighting);
  method.mutable_linear()->set_bounce(bounce);
  return method;
}

v1::Method rgb() {
  v1::Method method;
  method.mutable_rgb();
  return method;
}

v1::Method prefilter() {
  v1::Method method;
  method.mutable_prefilter();
  return method;
}

v1::Method exact() {
  v1::Method method;
  method.mutable_exact();
  return method;
}

v1::Method listed(const std::vector<double>& nm) {
  v1::Method method;
  method.mutable_point()->mutable_wavelengths()->Assign(nm.begin(), nm.end());
  method.mutable_point()->set_lights(v1::Point::SAMPLES);
  return method;
}

std::vector<v1::Method> all_methods() {
  std::vector<v1::Method> all{listed({555}),           listed({450, 600}),
                              listed({450, 550, 620}), uniform(400, 700, 5),
                              uniform(360, 830, 1),    uniform(400, 700, 0.075),  // 4001 samples
                              cells(360, 830, 10)};
  for (const MethodEntry& entry : method_entries())  // those without parameters
    if (!entry.fill) all.push_back(default_method(entry));
  for (const std::uint32_t count : {1u, 2u, 3u, 8u, 64u}) all.push_back(fitted(count));
  for (const std::uint32_t bases : {1u, 3u, 4u, 16u})
    for (const auto weighting : {v1::Linear::NONE, v1::Linear::OBSERVER})
      for (const bool bounce : {false, true}) all.push_back(linear(bases, weighting, bounce));
  return all;
}

}  // namespace metamer::test
