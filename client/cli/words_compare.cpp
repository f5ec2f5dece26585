#include "client/cli/words.h"

namespace metamer::cli {

void add_compare(CLI::App& app, CompareOptions& options, Action& chosen) {
  CLI::App& command =
      add_command(app, "compare", "how far two pictures are apart, as people see it", chosen,
                  [&] { return compare(options); });
  command.add_option("a", options.a, "a .png, or an .exr with X Y Z, RGB or spectra")->required();
  command.add_option("b", options.b, "another, of the same size")->required();
  command.add_option("--metric", options.metric, "ΔE00, ΔE*uv or ΔE*ab")
      ->check(CLI::IsMember({"de00", "deuv", "deab"}))
      ->capture_default_str();
  command.add_option("--max", options.max, "exit with 1 where a pixel differs by more")
      ->check(CLI::NonNegativeNumber);
  command.add_option("-o,--output", options.output, "a .png of the differences, with a legend");
  command
      .add_option("--scale", options.scale,
                  "the difference that is drawn white; else the 99th percentile, rounded up")
      ->check(CLI::PositiveNumber);
  command
      .add_option("--white", options.white,
                  "what looks white: X,Y,Z or a CIE illuminant; else that of --under, else D65")
      ->type_name("WHITE");
  command.add_option("--under", options.under, "the CIE illuminant that lights reflectances (T.)")
      ->type_name("ILLUMINANT");
  command.add_option("--observer", options.observer, "who sees spectra and illuminants")
      ->check(CLI::IsMember({"cie-1931-2deg", "cie-1964-10deg"}))
      ->capture_default_str();
  add_json(command, options.json);
  command.footer(footer);
}

}  // namespace metamer::cli
