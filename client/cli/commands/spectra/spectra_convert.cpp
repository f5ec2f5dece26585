// Spectra in another format.
#include "client/cli/commands.h"
#include "client/cli/commands/spectra/spectra_input.h"

namespace metamer::cli {
namespace {

using client::LoadedSpectrum;

struct ConvertOptions {
  SpectraOptions input;
  SpectraOutputOptions output;
};

ExitCode run(const ConvertOptions& options) {
  Report report(options.input.json);
  if (!check_spectra_output(options.output, report)) return report.finish(ExitCode::bad_input);
  const auto spectra = load_spectra(options.input, options.input.files, report);
  if (!spectra) return report.finish(ExitCode::bad_input);
  std::vector<NamedSpectrum> same;
  for (const LoadedSpectrum& one : *spectra)
    same.push_back({.name = one.name, .spectrum = one.samples});
  return report.finish(
      write_spectra(options.output, same, client::common_quantity(*spectra), report));
}

void declare(ConvertOptions& values, Options& options) {
  declare_spectra(values.input, options);
  declare_spectra_output(values.output, options);
}

}  // namespace

Command commands::spectra_convert() {
  return make_command<ConvertOptions>("spectra convert", "write in another format", declare, run);
}

}  // namespace metamer::cli
