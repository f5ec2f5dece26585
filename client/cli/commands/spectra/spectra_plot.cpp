// Spectra over wavelength as a picture.
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "client/cli/commands.h"
#include "client/cli/commands/spectra/spectra_input.h"
#include "client/cli/output/gnuplot.h"

namespace metamer::cli {
namespace {

using client::LoadedSpectrum;

struct PlotSpectraOptions {
  SpectraOptions input;
  std::string file;  ///< A .png.
};

/// More curves than this tell nothing, and gnuplot takes its time.
constexpr std::size_t most_curves = 64;

/// Okabe's and Ito's colours, which the colour-blind tell apart.
constexpr std::array curve_colors = {"#0072B2", "#D55E00", "#009E73",
                                     "#CC79A7", "#E69F00", "#56B4E9"};

/// Emissions on the left axis, reflectances on the right one, which ends at 1.
std::string script(const std::vector<LoadedSpectrum>& spectra) {
  const auto is_emission = [](const LoadedSpectrum& one) { return one.emission(); };
  const bool emissions = std::any_of(spectra.begin(), spectra.end(), is_emission);
  const bool reflectances = !std::all_of(spectra.begin(), spectra.end(), is_emission);
  std::string text =
      "set terminal pngcairo noenhanced size 1000,600 font 'DejaVu Sans,11'\n"
      "set key outside top center horizontal\nset grid lc rgb '#CCCCCC' lt 1\n"
      "set xlabel 'wavelength / nm'\nset border lc rgb '#888888'\n";
  if (emissions) text += "set ylabel 'relative power'\nset yrange [*<0:*]\n";
  if (reflectances)
    text += emissions ? "set ytics nomirror\nset y2tics\nset y2label 'reflectance'\nset y2range "
                        "[*<0:1<*]\n"
                      : "set ylabel 'reflectance'\nset yrange [*<0:1<*]\n";
  std::string plots;
  for (std::size_t i = 0; i < spectra.size(); ++i) {
    const Spectrum& spectrum = spectra[i].spectrum();
    const std::string block = "$d" + std::to_string(i);
    text += block + " << EOD\n";
    for (std::size_t k = 0; k < spectrum.nm.size(); ++k)
      text += number_text(spectrum.nm[k]) + " " + number_text(spectrum.values[k]) + "\n";
    text += "EOD\n";
    const bool right = emissions && !spectra[i].emission();
    plots += (plots.empty() ? "plot " : ", ") + block + " using 1:2 axes " +
             (right ? "x1y2" : "x1y1") + " with " +
             (spectrum.nm.size() == 1 ? "points pt 7" : "lines lw 2.2") + " lc rgb " +
             gnuplot_quote(curve_colors[i % curve_colors.size()]) + " dt " +
             (i < curve_colors.size() ? "1" : "2") + " title " +
             gnuplot_quote(spectra[i].label + (right ? " (right)" : ""));
  }
  return text + plots + "\n";
}

ExitCode run(const PlotSpectraOptions& options) {
  Report report(options.input.json);
  if (std::filesystem::path(options.file).extension() != ".png") {
    report.error("--output: " + quoted(options.file) + " does not end in .png");
    return report.finish(ExitCode::bad_input);
  }
  const auto spectra = load_spectra(options.input, options.input.files, report);
  if (!spectra) return report.finish(ExitCode::bad_input);
  if (spectra->size() > most_curves) {
    report.error("a picture takes at most " + std::to_string(most_curves) + " spectra, not " +
                 std::to_string(spectra->size()));
    return report.finish(ExitCode::bad_input);
  }
  if (const Result<void> drawn = draw_png(script(*spectra), options.file); !drawn) {
    report.problem(drawn.error(), {});
    return report.finish(ExitCode::other);
  }
  report.document()["files"].push_back(options.file);
  report.line(options.file);
  return report.finish(ExitCode::done);
}

void declare(PlotSpectraOptions& values, Options& options) {
  declare_spectra(values.input, options);
  options.push_back(
      {.names = "-o,--output", .target = &values.file, .meaning = "a .png", .required = true});
}

}  // namespace

Command commands::spectra_plot() {
  return make_command<PlotSpectraOptions>("spectra plot", "draw them over wavelength", declare,
                                          run);
}

}  // namespace metamer::cli
