#include "client/cli/words.h"

namespace metamer::cli {

void add_development(CLI::App& command, DevelopmentOptions& options, const char* group) {
  const auto add = [&](const char* name, auto& value, const char* meaning) {
    command.add_option(name, value, meaning)->group(group);
  };
  add("--adapt", options.adaptation,
      "to the dominant light's white: none, von-kries, bradford, sharp or cmccat2000");
  add("--rgb", options.rgb,
      "srgb, display-p3, adobe-rgb, prophoto, rec-2020 or cie-rgb, for .png and .exr alike");
  command.add_flag("--linear", options.linear, "a .png without the space's transfer function")
      ->group(group);
}

}  // namespace metamer::cli
