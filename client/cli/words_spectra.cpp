#include "client/cli/words.h"

namespace metamer::cli {
namespace {

void add_input(CLI::App& command, SpectraOptions& options) {
  command
      .add_option("files", options.files,
                  "spectrum files, or names of the CIE's illuminants and test colours: D65 TCS09")
      ->required();
  command.add_option("--entry", options.entry, "of files with several spectra, the one so named");
  command.add_option("--as", options.kind,
                     "emission or reflectance; a file whose values all lie in 0..1 is taken for a "
                     "reflectance");
  add_json(command, options.json);
}

void add_observer(CLI::App& command, SpectraOptions& options) {
  command.add_option("--observer", options.observer, "cie-1931-2deg or cie-1964-10deg")
      ->capture_default_str();
}

void add_under(CLI::App& command, SpectraOptions& options) {
  command.add_option("--under", options.under, "the light of reflectances: a name or a file")
      ->capture_default_str();
}

CLI::Option* add_file(CLI::App& command, SpectraOutputOptions& options) {
  command.add_option("--format", options.format,
                     "pairs, uniform or cgats; else by the file's name: .sp is CGATS");
  return command.add_option("-o,--output", options.file, "a file; printed when left out");
}

void add_changes(CLI::App& spectra, SpectraCommands& all, Action& chosen) {
  CLI::App& resample =
      add_command(spectra, "resample", "at other wavelengths, with what falls between them counted",
                  chosen, [&] { return resample_spectra(all.resample); });
  add_input(resample, all.resample.input);
  resample.add_option("--samples", all.resample.samples, "FROM:TO:STEP nm, such as 400:700:5");
  resample.add_option("--wavelengths", all.resample.wavelengths, "nm, such as 400,436,546,700");
  add_file(resample, all.resample.output);

  CLI::App& normalize = add_command(spectra, "normalize", "scale lights to a luminance", chosen,
                                    [&] { return normalize_spectra(all.normalize); });
  add_input(normalize, all.normalize.input);
  add_observer(normalize, all.normalize.input);
  normalize.add_option("--luminance", all.normalize.luminance, "above 0")->capture_default_str();
  add_file(normalize, all.normalize.output);

  CLI::App& convert = add_command(spectra, "convert", "write in another format", chosen,
                                  [&] { return convert_spectra(all.convert); });
  add_input(convert, all.convert.input);
  add_file(convert, all.convert.output);
}

}  // namespace

void add_spectra_commands(CLI::App& app, SpectraCommands& all, Action& chosen) {
  CLI::App* spectra =
      app.add_subcommand("spectra", "explain, plot, resample, convert and match spectra");
  spectra->require_subcommand(1);
  spectra->footer(footer);

  CLI::App& info = add_command(*spectra, "info", "range, luminance, chromaticity, temperature, Ra",
                               chosen, [&] { return spectra_info(all.info); });
  add_input(info, all.info);
  add_observer(info, all.info);
  add_under(info, all.info);

  CLI::App& plot = add_command(*spectra, "plot", "draw them over wavelength", chosen,
                               [&] { return plot_spectra(all.plot); });
  add_input(plot, all.plot.input);
  plot.add_option("-o,--output", all.plot.file, "a .png")->required();

  add_changes(*spectra, all, chosen);

  CLI::App& rgb = add_command(*spectra, "rgb", "their values in an RGB space", chosen,
                              [&] { return spectra_rgb(all.rgb); });
  add_input(rgb, all.rgb.input);
  add_observer(rgb, all.rgb.input);
  add_under(rgb, all.rgb.input);
  rgb.add_option("--luminance", all.rgb.luminance, "of the light")->capture_default_str();
  add_development(rgb, all.rgb.development, "Development");

  CLI::App& metamer = add_command(
      *spectra, "metamer",
      "write a reflectance that looks the same under one light and differs under another", chosen,
      [&] { return find_metamer(all.metamer); });
  add_input(metamer, all.metamer.input);
  metamer.get_option("files")->expected(1);
  add_observer(metamer, all.metamer.input);
  add_under(metamer, all.metamer.input);
  metamer.add_option("--against", all.metamer.against,
                     "the light under which it shall differ; A when left out");
  add_file(metamer, all.metamer.output)->required();
}

}  // namespace metamer::cli
