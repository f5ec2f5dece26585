#include "client/cli/words.h"

namespace metamer::cli {

void add_tradeoff(CLI::App& app, TradeoffOptions& options, Action& chosen) {
  CLI::App& command = add_command(
      app, "tradeoff", "what every method costs and how far it is off, on a scene of yours", chosen,
      [&] { return tradeoff(options); });
  add_scene(command, options.scene);
  command
      .add_option("-o,--output", options.folder,
                  "the folder for tradeoff.csv, .json, .png and the pictures of the differences")
      ->required();
  command.add_option("--rounds", options.rounds, "renderings of each; the quickest counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_overrides(command, options.overrides);
  add_common(command, options.common);
}

}  // namespace metamer::cli
