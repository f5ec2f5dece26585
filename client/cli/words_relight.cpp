#include "client/cli/words.h"

namespace metamer::cli {

void add_relight(CLI::App& app, RelightOptions& options, Action& chosen) {
  CLI::App& command = add_command(
      app, "relight", "give a kept picture other light, paint or observer, without a ray", chosen,
      [&] { return relight(options); });
  command.add_option("file", options.file, "what render --keep-factors wrote")->required();
  const auto add_swap = [&](const char* name, std::vector<std::string>& values, const char* type,
                            const char* meaning) {
    command.add_option(name, values, meaning)->type_name(type)->allow_extra_args(false);
  };
  add_swap("--light", options.lights, "NAME=SPECTRUM",
           "a light's spectrum: a CIE illuminant, a file, or FILE#ENTRY; *=A for all lights");
  add_swap(
      "--material", options.materials, "NAME=SPECTRUM",
      "a material's diffuse spectrum, or NAME.specular=: a CIE test colour, a file or FILE#ENTRY");
  command.add_option("--observer", options.observer, "cie-1931-2deg or cie-1964-10deg");
  add_development(command, options.development, "In place of what the picture was rendered with");
  add_picture_files(command, options.output);
  add_json(command, options.json);
  command.footer(footer);
}

}  // namespace metamer::cli
