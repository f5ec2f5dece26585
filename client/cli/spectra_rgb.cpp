// Trichromatic values of spectra (4.7.1).
#include <cmath>
#include <cstdio>

#include "client/cli/commands.h"
#include "client/cli/development.h"
#include "client/cli/spectra_input.h"

namespace metamer::cli {
namespace {

std::string three(const std::array<double, 3>& values) {
  char text[96];
  std::snprintf(text, sizeof text, "%.6f %.6f %.6f", values[0], values[1], values[2]);
  return text;
}

/// X Y Z of a light of this luminance, or of a reflectance under it.
Xyz tristimulus(const LoadedSpectrum& one, const Spectrum& light, const Wavelengths& wavelengths,
                const ObserverWeights& observer, double luminance) {
  std::vector<double> power = resample(light, wavelengths.nm(), Outside::zero).values;
  const double scale = luminance_scale(observer, power, luminance);
  if (!one.emission) {
    const auto reflected = resample(one.spectrum, wavelengths.nm(), Outside::hold).values;
    for (std::size_t i = 0; i < power.size(); ++i) power[i] *= reflected[i];
  }
  const Xyz xyz = to_xyz(observer, power);
  return {scale * xyz[0], scale * xyz[1], scale * xyz[2]};
}

/// What turns X Y Z under this light into RGB: the plan of a picture lit by it alone.
Result<PlannedDeveloping> developing_under(const Xyz& white, const v1::Development& development) {
  v1::Plan plan;
  *plan.mutable_development() = development;
  for (const double value : white)
    if (white[1] > 0) plan.add_source_white(value / white[1]);
  return planned_developing(plan);
}

void add(const LoadedSpectrum& one, const Xyz& xyz, const PlannedDeveloping& planned,
         Report& report) {
  const RgbSpace& space = planned.developing.space;
  const Rgb linear = multiply(multiply(space.from_xyz, planned.developing.adaptation), xyz);
  Rgb encoded = linear;
  if (!planned.developing.linear)
    for (double& value : encoded) value = encode(space.transfer, value);
  bool inside = true;
  for (const double value : linear) inside = inside && value >= -1e-9 && value <= 1 + 1e-9;
  report.document()["spectra"].push_back({{"name", one.label},
                                          {"xyz", xyz},
                                          {"rgb_space", space.word},
                                          {"linear", linear},
                                          {"encoded", encoded},
                                          {"in_gamut", inside}});
  report.line(one.label + "\n  XYZ     " + three(xyz) + "\n  linear  " + three(linear) +
              "\n  encoded " + three(encoded) + " (" + space.name + ")" +
              (inside ? "" : "\n  out of gamut: a .png would clip it"));
  if (!planned.unadapted.empty())
    report.note({.field = {}, .file = one.label, .message = "not adapted: " + planned.unadapted});
}

}  // namespace

ExitCode spectra_rgb(const SpectraRgbOptions& options) {
  Report report(options.input.json);
  v1::Development development;
  const auto words = apply(options.development, development);
  const auto observer = observer_of(options.input.observer);
  if (!words) report.error(words.error().message);
  if (!observer) report.error(observer.error().message);
  const bool luminous = options.luminance > 0 && std::isfinite(options.luminance);
  if (!luminous) report.error("--luminance must be above 0");
  if (!words || !observer || !luminous) return report.finish(ExitCode::bad_input);
  const auto spectra = load_spectra(options.input, options.input.files, report);
  const auto under = load_light(options.input.under, "--under", report);
  if (!spectra || !under) return report.finish(ExitCode::bad_input);

  for (const LoadedSpectrum& one : *spectra) {
    const Spectrum& light = one.emission ? one.spectrum : *under;
    const Wavelengths wavelengths = fine_wavelengths(light);
    const ObserverWeights eye = observer_weights(*observer, wavelengths);
    const Xyz white = to_xyz(eye, resample(light, wavelengths.nm(), Outside::zero).values);
    const auto planned = developing_under(white, development);
    if (!planned) {
      report.error(planned.error().message);
      return report.finish(ExitCode::bad_input);
    }
    if (!(white[1] > 0))
      report.note({.field = {}, .file = one.label, .message = "its light is dark: all is 0"});
    add(one, tristimulus(one, light, wavelengths, eye, options.luminance), *planned, report);
  }
  return report.finish(ExitCode::done);
}

}  // namespace metamer::cli
