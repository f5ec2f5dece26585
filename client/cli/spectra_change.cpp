// Spectra at other wavelengths, of another luminance, in another format.
#include <cmath>
#include <cstdio>

#include "client/cli/commands.h"
#include "client/cli/spectra_input.h"
#include "client/tools/spectra_change.h"

namespace metamer::cli {
namespace {

using client::LoadedSpectrum;

std::string percent(double share) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g %%", 100 * std::abs(share));
  return text;
}

void note(const LoadedSpectrum& one, const std::string& message, Report& report) {
  report.note({.field = {}, .file = one.label, .message = message});
}

/// Says what lies outside the new samples, fell between them, or was widened by them.
void report_change(const LoadedSpectrum& one, const client::ResampledSpectrum& made,
                   const Wavelengths& wavelengths, Report& report) {
  if (made.without_data > 0)
    note(one,
         std::to_string(made.without_data) + " of " + std::to_string(wavelengths.size()) +
             " wavelengths lie outside its data: " + (one.emission ? "0" : "its end value") +
             " there",
         report);
  const EnergyCheck& energy = made.energy;
  report.document()["spectra"].push_back({{"name", one.label},
                                          {"integral_before", energy.before},
                                          {"integral_after", energy.after},
                                          {"integral_outside", energy.outside}});
  const std::string what = one.emission ? "energy" : "area";
  if (made.leaves_out)
    note(one,
         percent(energy.outside / (energy.before + energy.outside)) + " of its " + what +
             " lies outside the new range",
         report);
  if (!made.changes) return;
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
    client::ResampledSpectrum changed = client::resampled(one, *wavelengths);
    report_change(one, changed, *wavelengths, report);
    made.push_back(std::move(changed.spectrum));
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
    auto changed = client::normalized(one, *observer, options.luminance);
    if (!changed)
      return refuse(
          changed.error().message + (one.emission ? "" : "; --as emission says otherwise"), report);
    made.push_back(std::move(changed->spectrum));
    report.document()["spectra"].push_back({{"name", one.label}, {"factor", changed->factor}});
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
