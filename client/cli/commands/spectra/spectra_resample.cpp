// Spectra at other wavelengths.
#include <cmath>
#include <cstdio>

#include "client/cli/commands.h"
#include "client/cli/commands/spectra/spectra_input.h"
#include "client/tools/spectra/spectra_change.h"

namespace metamer::cli {
namespace {

using client::LoadedSpectrum;

struct ResampleOptions {
  SpectraOptions input;
  std::optional<std::string> samples, wavelengths;  ///< As in Overrides.
  SpectraOutputOptions output;
};

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
             " wavelengths lie outside its data: " + (one.emission() ? "0" : "its end value") +
             " there",
         report);
  const EnergyCheck& energy = made.energy;
  report.document()["spectra"].push_back({{"name", one.label},
                                          {"integral_before", energy.before},
                                          {"integral_after", energy.after},
                                          {"integral_outside", energy.outside}});
  const std::string what = one.emission() ? "energy" : "area";
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

ExitCode run(const ResampleOptions& options) {
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
  return report.finish(
      write_spectra(options.output, made, client::common_quantity(*spectra), report));
}

void declare(ResampleOptions& values, Options& options) {
  declare_spectra(values.input, options);
  options.push_back({.names = "--samples",
                     .target = &values.samples,
                     .meaning = "FROM:TO:STEP nm, such as 400:700:5"});
  options.push_back({.names = "--wavelengths",
                     .target = &values.wavelengths,
                     .meaning = "nm, such as 400,436,546,700"});
  declare_spectra_output(values.output, options);
}

}  // namespace

Command commands::spectra_resample() {
  return make_command<ResampleOptions>("spectra resample",
                                       "at other wavelengths, with what falls between them counted",
                                       declare, run);
}

}  // namespace metamer::cli
