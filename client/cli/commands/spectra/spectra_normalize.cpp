// Lights of another luminance.
#include <cmath>

#include "client/cli/commands.h"
#include "client/cli/commands/spectra/spectra_input.h"
#include "client/tools/spectra/spectra_change.h"

namespace metamer::cli {
namespace {

using client::LoadedSpectrum;

struct NormalizeOptions {
  SpectraOptions input;
  double luminance = 1;
  SpectraOutputOptions output;
};

ExitCode run(const NormalizeOptions& options) {
  Report report(options.input.json);
  const auto observer = load_observer(options.input.observer, report);
  if (!observer) return report.finish(ExitCode::bad_input);
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
          changed.error().message + (one.emission() ? "" : "; --as emission says otherwise"),
          report);
    made.push_back(std::move(changed->spectrum));
    report.document()["spectra"].push_back({{"name", one.label}, {"factor", changed->factor}});
  }
  return report.finish(
      write_spectra(options.output, made, client::common_quantity(*spectra), report));
}

void declare(NormalizeOptions& values, Options& options) {
  declare_spectra(values.input, options);
  declare_observer(values.input, options);
  options.push_back({.names = "--luminance",
                     .target = &values.luminance,
                     .meaning = "above 0",
                     .shows_default = true});
  declare_spectra_output(values.output, options);
}

}  // namespace

Command commands::spectra_normalize() {
  return make_command<NormalizeOptions>("spectra normalize", "scale lights to a luminance", declare,
                                        run);
}

}  // namespace metamer::cli
