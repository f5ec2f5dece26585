// Trichromatic values of spectra (4.7.1).
#include <cmath>
#include <cstdio>

#include "client/cli/commands.h"
#include "client/cli/commands/spectra/spectra_input.h"
#include "client/cli/development.h"
#include "client/tools/spectra/spectrum_rgb.h"

namespace metamer::cli {
namespace {

struct SpectraRgbOptions {
  SpectraOptions input;
  DevelopmentOptions development;
  double luminance = 1;  ///< Of the light: an emission, or the one that reflectances are under.
};

std::string three(const std::array<double, 3>& values) {
  char text[96];
  std::snprintf(text, sizeof text, "%.6f %.6f %.6f", values[0], values[1], values[2]);
  return text;
}

void add(const client::LoadedSpectrum& one, const client::SpectrumRgb& rgb, Report& report) {
  const auto note = [&](const std::string& message) {
    report.note({.field = {}, .file = one.label, .message = message});
  };
  if (rgb.dark) note("its light is dark: all is 0");
  report.document()["spectra"].push_back({{"name", one.label},
                                          {"xyz", rgb.xyz},
                                          {"rgb_space", rgb.space.word},
                                          {"linear", rgb.linear},
                                          {"encoded", rgb.encoded},
                                          {"in_gamut", rgb.in_gamut}});
  report.line(one.label + "\n  XYZ     " + three(rgb.xyz) + "\n  linear  " + three(rgb.linear) +
              "\n  encoded " + three(rgb.encoded) + " (" + rgb.space.name + ")" +
              (rgb.in_gamut ? "" : "\n  out of gamut: a .png would clip it"));
  if (!rgb.unadapted.empty()) note("not adapted: " + rgb.unadapted);
  if (!rgb.shown_white.empty()) note(rgb.shown_white);
}

ExitCode run(const SpectraRgbOptions& options) {
  Report report(options.input.json);
  v1::Development development;
  const auto words = apply(options.development, development);
  const auto observer = load_observer(options.input.observer, report);
  if (!words) report.error(words.error().message);
  const bool luminous = options.luminance > 0 && std::isfinite(options.luminance);
  if (!luminous) report.error("--luminance must be above 0");
  if (!words || !observer || !luminous) return report.finish(ExitCode::bad_input);
  const auto spectra = load_spectra(options.input, options.input.files, report);
  const auto under = load_light(options.input.under, "--under", *observer, report);
  if (!spectra || !under) return report.finish(ExitCode::bad_input);
  tell_ends_of(*spectra, {{options.input.under, *under, *observer}}, *observer, report);

  for (const client::LoadedSpectrum& one : *spectra) {
    const auto rgb = client::spectrum_rgb(one, *under, *observer, options.luminance, development,
                                          *find_table_weights(options.input.weights));
    if (!rgb) {
      report.error(rgb.error().message);
      return report.finish(ExitCode::bad_input);
    }
    add(one, *rgb, report);
  }
  return report.finish(ExitCode::done);
}

void declare(SpectraRgbOptions& values, Options& options) {
  declare_spectra(values.input, options);
  declare_observer(values.input, options);
  declare_under(values.input, options);
  declare_weights(values.input.weights, options);
  options.push_back({.names = "--luminance",
                     .target = &values.luminance,
                     .meaning = "of the light",
                     .shows_default = true});
  declare_development(values.development, "Development", options);
}

}  // namespace

Command commands::spectra_rgb() {
  return make_command<SpectraRgbOptions>("spectra rgb", "their values in an RGB space", declare,
                                         run);
}

}  // namespace metamer::cli
