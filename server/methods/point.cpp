#include "server/methods/point.h"

#include "common/color/xyz.h"
#include "common/scene/settings.h"
#include "server/methods/banded.h"
#include "server/methods/direct_errors.h"
#include "server/methods/fitted.h"

namespace metamer {
namespace {

/// What a light is around each wavelength; around a single one, all of it that anybody sees.
std::vector<double> cell_power(const Spectrum& emission, const std::vector<double>& nm) {
  if (nm.size() > 1) return band_means(emission, nm);
  const std::vector<double> ends = light_shares(emission, {observer_from_nm, observer_to_nm});
  return {(ends[0] + ends[1]) / (observer_to_nm - observer_from_nm)};
}

std::unique_ptr<Method> make(const Wavelengths& wavelengths, const Observer& choice,
                             v1::Point::Lights kind, const RenderScene& scene) {
  const bool cells = kind == v1::Point::CELLS;
  const ObserverWeights observer =
      cells ? observer_of_bands(choice, wavelengths.nm()) : observer_weights(choice, wavelengths);
  const std::size_t bands = wavelengths.size();

  // Give each light its luminance with these very samples, E[3.2-4].
  LightTables lights(scene, bands, [&](const Spectrum& emission, double luminance) {
    auto power = cells ? cell_power(emission, wavelengths.nm())
                       : resample(emission, wavelengths.nm(), Outside::zero).values;
    // An observer of bands falls below 0 beside what it sees: light there stays dark.
    const double scale = std::max(0.0, luminance_scale(observer, power, luminance));
    for (double& value : power) value *= scale;
    return power;
  });

  FactorRows rows(scene);
  BandTable values(rows.size(), bands);
  rows.for_each(scene, wavelengths.nm(),
                [&](std::uint32_t row, const std::vector<double>& at) { values.set(row, at); });

  BandTable xyz(3, bands);
  for (std::size_t i = 0; i < 3; ++i) xyz.set(i, observer.weights[i]);
  return std::make_unique<BandedMethod>(
      std::move(rows), BandedMethod::Tables{std::move(lights), std::move(values), std::move(xyz)});
}

double largest(const std::vector<LightError>& errors) {
  double most = 0;
  for (const LightError& error : errors) most = std::max({most, error.white, error.material});
  return most;
}

v1::Point::Lights better_lights(const Wavelengths& wavelengths, const Observer& observer,
                                const RenderScene& scene) {
  const DirectColors truth(scene, observer);
  const auto error_of = [&](v1::Point::Lights kind) {
    return largest(truth.errors(*make(wavelengths, observer, kind, scene)));
  };
  const double sampled = error_of(v1::Point::SAMPLES), meant = error_of(v1::Point::CELLS);
  return meant < sampled ? v1::Point::CELLS : v1::Point::SAMPLES;
}

}  // namespace

std::unique_ptr<Method> make_sampled(const Wavelengths& wavelengths, const Observer& observer,
                                     const RenderScene& scene) {
  return make(wavelengths, observer, v1::Point::SAMPLES, scene);
}

Wavelengths wavelengths_of_point(const v1::Method& method) {
  return method.point().has_fitted() ? observer_wavelengths() : *point_wavelengths(method.point());
}

void plan_point(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan) {
  if (settings.method().point().has_fitted()) return plan_fitted(scene, settings, plan);
  const Wavelengths wavelengths = wavelengths_of_point(settings.method());
  plan.set_bands(static_cast<std::uint32_t>(wavelengths.size()));
  if (settings.method().point().multi_pass() && !scene.fluorescences.empty()) {
    plan.mutable_method()->mutable_point()->set_multi_pass(false);
    v1::Notice* notice = plan.add_notice();
    notice->set_field("settings.method.point.multi_pass");
    notice->set_message("has no effect: what fluorescence re-radiates comes of other wavelengths");
  }
  if (settings.method().point().lights() == v1::Point::BETTER)
    plan.mutable_method()->mutable_point()->set_lights(
        better_lights(wavelengths, scene.observer, scene));
}

std::unique_ptr<Method> make_point(const v1::Plan& plan, const RenderScene& scene) {
  if (plan.method().point().has_fitted()) return make_fitted(plan, scene);
  return make(wavelengths_of_point(plan.method()), scene.observer, plan.method().point().lights(),
              scene);
}

}  // namespace metamer
