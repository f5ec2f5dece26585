// Spectra at other wavelengths, of another luminance, in another format.
#include <cmath>
#include <cstdio>

#include "client/cli/commands.h"
#include "client/cli/spectra_input.h"

namespace metamer::cli {
namespace {

/// What a sampling may change of an integral without a word.
constexpr double tolerated = 0.01;

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100 * std::abs(share));
  return text;
}

void note(const LoadedSpectrum& one, const std::string& message, Report& report) {
  report.note({.field = {}, .file = one.label, .message = message});
}

/// Says what fell between the new samples, was widened by them, or lies outside.
void report_energy(const LoadedSpectrum& one, const EnergyCheck& energy, Report& report) {
  report.document()["spectra"].push_back({{"name", one.label},
                                          {"integral_before", energy.before},
                                          {"integral_after", energy.after},
                                          {"integral_outside", energy.outside}});
  const double whole = energy.before + energy.outside;
  if (!(whole > 0)) return;
  const std::string what = one.emission ? "energy" : "area";
  if (energy.outside > tolerated * whole)
    note(one, percent(energy.outside / whole) + " of its " + what + " lies outside the new range",
         report);
  if (!(energy.before > 0) || std::abs(energy.worst) <= tolerated * energy.before) return;
  const auto changed = [&](double by) {
    return percent(by / energy.before) + (by < 0 ? " of it is missed" : " of it is added");
  };
  note(one,
       "the new samples change its " + what + ": " + changed(energy.worst) + " between " +
           number_text(energy.worst_from) + " and " + number_text(energy.worst_to) + " nm, " +
           changed(energy.after - energy.before) + " in all",
       report);
}

ExitCode refuse(const std::string& why, Report& report) {
  report.error(why);
  return report.finish(ExitCode::bad_input);
}

}  // namespace

ExitCode resample_spectra(const ResampleOptions& options) {
  Report report(options.input.json);
  if (!options.samples && !options.wavelengths)
    return refuse("say where: --samples FROM:TO:STEP or --wavelengths NM,NM,…", report);
  const auto wavelengths = wavelengths_of(options.samples, options.wavelengths);
  if (!wavelengths) return refuse(wavelengths.error().message, report);
  if (!check_spectra_output(options.output, report)) return report.finish(ExitCode::bad_input);
  const auto spectra = load_spectra(options.input, options.input.files, report);
  if (!spectra) return report.finish(ExitCode::bad_input);

  std::vector<NamedSpectrum> made;
  for (const LoadedSpectrum& one : *spectra) {
    const Resampled values = resample(one.spectrum, wavelengths->nm(), one.outside());
    if (values.below + values.above > 0)
      note(one,
           std::to_string(values.below + values.above) + " of " +
               std::to_string(wavelengths->size()) + " wavelengths lie outside its data: " +
               (one.emission ? "0" : "its end value") + " there",
           report);
    made.push_back({.name = one.name, .spectrum = {wavelengths->nm(), values.values}});
    report_energy(one, check_energy(one.spectrum, made.back().spectrum, one.outside()), report);
  }
  return report.finish(write_spectra(options.output, made, report));
}

ExitCode normalize_spectra(const NormalizeOptions& options) {
  Report report(options.input.json);
  const auto observer = observer_of(options.input.observer);
  if (!observer) return refuse(observer.error().message, report);
  if (!(options.luminance > 0) || !std::isfinite(options.luminance))
    return refuse("--luminance must be above 0", report);
  if (!check_spectra_output(options.output, report)) return report.finish(ExitCode::bad_input);
  const auto spectra = load_spectra(options.input, options.input.files, report);
  if (!spectra) return report.finish(ExitCode::bad_input);

  std::vector<NamedSpectrum> made;
  for (const LoadedSpectrum& one : *spectra) {
    if (!one.emission)
      return refuse(quoted(one.label) +
                        " is taken for a reflectance, which has no luminance of its own; "
                        "--as emission says otherwise",
                    report);
    const Wavelengths wavelengths = own_wavelengths(one.spectrum);
    const double factor = luminance_scale(
        observer_weights(*observer, wavelengths),
        resample(one.spectrum, wavelengths.nm(), Outside::zero).values, options.luminance);
    if (!(factor > 0)) return refuse(quoted(one.label) + " is dark to this observer", report);
    made.push_back({.name = one.name, .spectrum = one.spectrum});
    for (double& value : made.back().spectrum.values) value *= factor;
    if (!make_spectrum(made.back().spectrum.nm, made.back().spectrum.values))
      return refuse(quoted(one.label) + " overflows at that luminance", report);
    report.document()["spectra"].push_back({{"name", one.label}, {"factor", factor}});
  }
  return report.finish(write_spectra(options.output, made, report));
}

ExitCode convert_spectra(const ConvertOptions& options) {
  Report report(options.input.json);
  if (!check_spectra_output(options.output, report)) return report.finish(ExitCode::bad_input);
  const auto spectra = load_spectra(options.input, options.input.files, report);
  if (!spectra) return report.finish(ExitCode::bad_input);
  std::vector<NamedSpectrum> same;
  for (const LoadedSpectrum& one : *spectra)
    same.push_back({.name = one.name, .spectrum = one.spectrum});
  return report.finish(write_spectra(options.output, same, report));
}

}  // namespace metamer::cli
