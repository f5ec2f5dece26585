// A reflectance that looks the same under one light and another under another.
#include <cstdio>

#include "client/cli/commands.h"
#include "client/cli/commands/spectra/spectra_input.h"
#include "client/tools/spectra/metamer_table.h"

namespace metamer::cli {
namespace {

struct MetamerOptions {
  SpectraOptions input;
  std::string against;          ///< Empty: A, or D65 where that is the light.
  SpectraOutputOptions output;  ///< Its file is not empty.
};

void add_differences(const std::vector<Mismatch>& all, Report& report) {
  std::string text = "light  ΔE00   ΔE*ab  ΔE*uv";
  for (const Mismatch& one : all) {
    report.document()["differences"].push_back(
        {{"light", one.light}, {"de00", one.de00}, {"deab", one.deab}, {"deuv", one.deuv}});
    char line[96];
    std::snprintf(line, sizeof line, "\n%-5s %6.2f %6.2f %6.2f", one.light.c_str(), one.de00,
                  one.deab, one.deuv);
    text += line;
  }
  report.line(text);
}

ExitCode run(const MetamerOptions& options) {
  Report report(options.input.json);
  const auto observer = load_observer(options.input.observer, report);
  if (!observer) return report.finish(ExitCode::bad_input);
  if (!check_spectra_output(options.output, report)) return report.finish(ExitCode::bad_input);

  const std::string other =
      !options.against.empty() ? options.against : client::usual_other_light(options.input.under);
  if (other == options.input.under) {
    report.error("--against: " + quoted(other) + " is the light that they match under");
    return report.finish(ExitCode::bad_input);
  }
  SpectraOptions input = options.input;
  if (!input.as) input.as = "reflectance";
  const auto original = load_one(input, input.files.front(), report);
  const auto under = load_light(input.under, "--under", *observer, report);
  const auto against = load_light(other, "--against", *observer, report);
  if (!original || !under || !against) return report.finish(ExitCode::bad_input);
  tell_ends_of({*original}, {{input.under, *under, *observer}, {other, *against, *observer}},
               *observer, report);

  const auto table = client::metamer_table(original->spectrum(), {options.input.under, *under},
                                           {other, *against}, *observer);
  if (!table) {
    report.error(quoted(original->label) + ": " + table.error().message);
    return report.finish(ExitCode::bad_input);
  }
  const ExitCode written = write_spectra(
      options.output, {{.name = original->name + "-metamer", .spectrum = table->reflectance}},
      Quantity::reflectance, report);
  if (written != ExitCode::done) return report.finish(written);
  add_differences(table->differences, report);
  return report.finish(ExitCode::done);
}

void declare(MetamerOptions& values, Options& options) {
  declare_spectra(values.input, options, true);
  declare_observer(values.input, options);
  declare_under(values.input, options);
  options.push_back({.names = "--against",
                     .target = &values.against,
                     .meaning = "the light under which it shall differ; A when left out"});
  declare_spectra_output(values.output, options, true);
}

}  // namespace

Command commands::spectra_metamer() {
  return make_command<MetamerOptions>(
      "spectra metamer",
      "write a reflectance that looks the same under one light and differs under another", declare,
      run);
}

}  // namespace metamer::cli
