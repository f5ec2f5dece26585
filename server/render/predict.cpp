#include "server/render/predict.h"

#include <chrono>

#include "common/scene/settings.h"
#include "server/render/noise.h"
#include "server/render/thread_time.h"

namespace metamer {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

v1::Method any_method() {
  v1::Method method;
  method.mutable_rgb();
  return method;
}

/// A ray on one core, ns, with its share of a model: what the demo's booth takes.
constexpr double ray_cost = 200;

double mean_resolve_cost(const Method& method, const std::vector<Gather>& pixels) {
  double sum = 0;
  for (const Gather& gather : pixels) sum += method.resolve_cost(gather);
  return sum / static_cast<double>(std::max<std::size_t>(1, pixels.size()));
}

/// Pixels that no prediction has seen: as many again as the pilot has, twice.
PixelRun fresh_run(const v1::Plan& plan, std::uint32_t round) {
  const std::uint32_t count = pilot_count(plan);
  return {count * (1 + 2 * round), 2 * count};
}

/// What a method gets wrong on pixels that are traced for this.
v1::ColorError error_on(PixelRun run, const PilotScene& pilot, const v1::Plan& plan,
                        Reference& reference, const Method& method) {
  const PilotPixels pixels =
      trace_pixels(pilot.probe, plan, run, reference, pilot.stopped, pilot.work);
  return summarize(color_errors(method, pixels, {0, pixels.gathers.size()}, reference.white(),
                                *method.make_scratch()));
}

}  // namespace

v1::Plan plan_with(const PilotScene& pilot, const v1::Method& method) {
  v1::Settings settings = pilot.settings;
  *settings.mutable_method() = method;
  return make_plan(pilot.scene, with_defaults(settings), pilot.capabilities);
}

Predictor::Predictor(const PilotScene& pilot)
    : pilot_(pilot),
      plan_(plan_with(pilot, any_method())),
      reference_(pilot.scene, pilot.scene.observer),
      pixels_(trace_pixels(pilot.probe, plan_, {0, pilot_count(plan_)}, reference_, pilot.stopped,
                           pilot.work)),
      colors_(scene_colors(pilot.scene, reference_)),
      noise_(sampling_noise(pilot, plan_, *make_method(plan_, pilot.scene), reference_.white())),
      trace_cost_(pixels_.rays * ray_cost * plan_.width() * plan_.height()) {}

Predicted Predictor::predict(const v1::Method& method) {
  const auto start = Clock::now();
  Predicted predicted;
  v1::Prediction& prediction = predicted.prediction;
  const v1::Plan plan = plan_with(pilot_, method);
  *prediction.mutable_method() = plan.method();
  predicted.method = make_method(plan, pilot_.scene);
  prediction.set_prepare(seconds_since(start));

  // The first half of the pixels fills what the method remembers; the second is timed.
  const auto scratch = predicted.method->make_scratch();
  const std::size_t count = pixels_.gathers.size(), half = count / 2;
  const Xyz& white = reference_.white();
  std::vector<double> errors = color_errors(*predicted.method, pixels_, {0, half}, white, *scratch);
  const double half_time = thread_seconds();
  const std::vector<double> rest =
      color_errors(*predicted.method, pixels_, {half, count}, white, *scratch);
  const double resolve =
      (thread_seconds() - half_time) / static_cast<double>(std::max<std::size_t>(1, rest.size()));
  errors.insert(errors.end(), rest.begin(), rest.end());
  prediction.set_render(pilot_.probe.picture_seconds(
      plan, *predicted.method, pixels_.trace_seconds + resolve, pilot_.stopped, pilot_.work));
  *prediction.mutable_error() = summarize(errors);
  if (noise_) *prediction.mutable_noise() = *noise_;

  prediction.set_bound(summarize(color_errors(*predicted.method, colors_,
                                              {0, colors_.gathers.size()}, white, *scratch))
                           .maximum());
  const double resolve_cost = mean_resolve_cost(*predicted.method, pixels_.gathers);
  predicted.cost = trace_cost_ + predicted.method->preparation_cost() +
                   resolve_cost * plan.width() * plan.height();
  predicted.look = predicted.method->preparation_cost() +
                   resolve_cost * static_cast<double>(count + colors_.gathers.size());
  ++pilot_.work;
  predicted.took = seconds_since(start);
  return predicted;
}

v1::ColorError Predictor::check(const Method& method, std::uint32_t round) {
  return error_on(fresh_run(plan_, round), pilot_, plan_, reference_, method);
}

v1::Accuracy measure(const PilotScene& pilot, const Method& method) {
  const v1::Plan plan = plan_with(pilot, any_method());
  Reference reference(pilot.scene, pilot.scene.observer);
  const PixelRun run{.first = 0, .count = 2 * pilot_count(plan), .random = true};
  v1::ColorError error = error_on(run, pilot, plan, reference, method);
  error.set_share(bounded_share(run.count));
  v1::Accuracy accuracy = accuracy_of(error, plan, reference.white());
  if (const auto noise = sampling_noise(pilot, plan, method, reference.white()))
    *accuracy.mutable_noise() = *noise;
  return accuracy;
}

v1::Accuracy accuracy_of(const v1::ColorError& error, const v1::Plan& plan, const Xyz& white) {
  v1::Accuracy accuracy;
  *accuracy.mutable_error() = error;
  accuracy.set_kept(true);
  accuracy.set_observer(plan.observer());
  accuracy.set_observer_file(plan.observer_file());
  accuracy.mutable_white()->Add(white.begin(), white.end());
  return accuracy;
}

double counted_pixel_cost(const Method& method, const TracedPixels& pixels) {
  return pixels.rays * ray_cost + mean_resolve_cost(method, pixels.gathers);
}

}  // namespace metamer
