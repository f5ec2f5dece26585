#include "client/cli/words.h"

#include "common/scene/methods.h"

namespace metamer::cli {

const char* const footer =
    "Without --server (or METAMER_SERVER), render, check, bench and tradeoff start a private "
    "server\n"
    "and end it again; models, spectra, relight and compare need none; the other commands need "
    "one.\n"
    "\n"
    "Exit codes: 0 done, 2 bad input or usage, 3 no server, 4 job failed, 5 cancelled, 6 the\n"
    "picture is less accurate or slower than --tolerance or --deadline asked for, 1 otherwise\n"
    "(compare: over --max).";

void add_json(CLI::App& command, bool& json) {
  command.add_flag("--json", json, "one JSON document on stdout");
}

void add_common(CLI::App& command, CommonOptions& options) {
  command.add_option("--server", options.server, "unix:PATH or HOST:PORT; default $METAMER_SERVER");
  add_json(command, options.json);
  command.footer(footer);
}

void add_scene(CLI::App& command, std::string& scene) {
  command.add_option("scene", scene, "a scene file (.txtpb)")->required();
}

void add_job(CLI::App& command, std::uint64_t& job_id) {
  command.add_option("job", job_id, "the job's number")->required();
}

void add_overrides(CLI::App& command, Overrides& options) {
  const std::string group = "In place of the scene's settings";
  const auto add = [&](const char* name, auto& value, const std::string& meaning) {
    return command.add_option(name, value, meaning)->group(group);
  };
  add("--backend", options.backend, "cpu, a ray tracer, or gl: OpenGL, without mirrors");
  add("--method", options.method, "how colour is carried: " + method_words());
  add("--samples", options.samples, "point at FROM:TO:STEP nm, such as 400:700:5");
  add("--wavelengths", options.wavelengths, "point at these nm, such as 400,436,546,700");
  add("--fitted", options.fitted, "point at so many nm, 1 to 64, that are chosen for the scene");
  command
      .add_flag("--multi-pass", options.multi_pass,
                "point by the gl backend, drawing everything anew for each four wavelengths")
      ->group(group);
  add("--bases", options.bases, "linear with so many basis functions, 1 to 16");
  add("--tolerance", options.tolerance,
      "auto: the cheapest method whose ΔE00 against the 1 nm reference stays below this");
  add("--deadline", options.deadline,
      "auto: the most accurate method that takes no longer than this, such as 2s");
  add("--size", options.size, "WIDTHxHEIGHT in pixels");
  add("--spp", options.spp, "samples per pixel");
  add("--depth", options.depth, "mirror reflections that a path may take");
  add("--observer", options.observer, "cie-1931-2deg or cie-1964-10deg");
  add("--shading", options.shading,
      "phong, constant, gouraud or quadratic, where an object has none");
  add("--threads", options.threads, "0: as many as the server has");
  add("--tile-size", options.tile_size, "pixels, a multiple of 8");
  add("--light", options.lights, "give a light a CIE illuminant: NAME=A, or *=A for all of them")
      ->type_name("NAME=ILLUMINANT")
      ->allow_extra_args(false);
  add_development(command, options.development, group.c_str());
}

void add_picture_files(CLI::App& command, OutputOptions& options) {
  command.add_option("-o,--output", options.files, "a .png or .exr; may be given several times")
      ->required()
      ->allow_extra_args(false);
  command
      .add_option("--exr", options.exr,
                  "what an .exr holds: rgb (linear), xyz, spectral or spectral:FROM:TO:STEP nm")
      ->capture_default_str();
}

void add_output(CLI::App& command, OutputOptions& options) {
  add_picture_files(command, options);
  command
      .add_option_function<std::string>(
          "--keep-factors", [&options](const std::string& file) { options.factors = file; },
          "keep what relighting needs, in FILE or beside the first picture as .factors")
      ->type_name("[FILE]")
      ->expected(0, 1);
}

CLI::App& add_command(CLI::App& app, const char* name, const char* meaning, Action& chosen,
                      const Action& action) {
  CLI::App* command = app.add_subcommand(name, meaning);
  command->callback([&chosen, action] { chosen = action; });
  return *command;
}

}  // namespace metamer::cli
