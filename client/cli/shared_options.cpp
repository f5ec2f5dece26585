#include "client/cli/shared_options.h"

#include "common/color/table_weights.h"

#include "common/scene/methods.h"

namespace metamer::cli {

void declare_json(bool& json, Options& options) {
  options.push_back({.names = "--json", .target = &json, .meaning = "one JSON document on stdout"});
}

void declare_weights(std::string& word, Options& options) {
  options.push_back(
      {.names = "--weights",
       .target = &word,
       .meaning = "reflectances by their samples: lines for the integral between them, or astm for "
                  "samples by 10 or 20 nm (ASTM E308, table 5)",
       .shows_default = true,
       .choices = table_weights_words()});
}

void declare_common(CommonOptions& common, Options& options) {
  options.push_back({.names = "--server",
                     .target = &common.server,
                     .meaning = "unix:PATH, HOST:PORT or tls:HOST:PORT; default $METAMER_SERVER"});
  declare_json(common.json, options);
}

void declare_scene(std::string& scene, Options& options) {
  options.push_back(
      {.names = "scene", .target = &scene, .meaning = "a scene file (.txtpb)", .required = true});
}

void declare_job(std::string& job, Options& options) {
  options.push_back({.names = "job",
                     .target = &job,
                     .meaning = "the job: its handle, such as 7@3f9c2a1b, or its number",
                     .required = true});
}

void declare_jobs(std::string& job, Options& options) {
  options.push_back({.names = "job",
                     .target = &job,
                     .meaning = "the job: its handle, such as 7@3f9c2a1b, or its number; or a "
                                "series of jobs, such as series:3f9c2a1b, or series: and its name",
                     .required = true});
}

void declare_overrides(Overrides& overrides, Options& options) {
  const std::string group = "In place of the scene's settings";
  const auto add = [&](const char* name, Target target, const std::string& meaning) {
    options.push_back({.names = name, .target = target, .meaning = meaning, .group = group});
  };
  add("--look", &overrides.look,
      "one of the scene's looks, by its name; other options come after it");
  add("--backend", &overrides.backend,
      "cpu, a ray tracer, or gl: OpenGL, without mirrors and refraction");
  add("--method", &overrides.method, "how colour is carried: " + method_words() + " or auto");
  add("--samples", &overrides.samples, "point at FROM:TO:STEP nm, such as 400:700:5");
  add("--wavelengths", &overrides.wavelengths, "point at these nm, such as 400,436,546,700");
  add("--fitted", &overrides.fitted, "point at so many nm, 1 to 64, that are chosen for the scene");
  add("--multi-pass", &overrides.multi_pass,
      "point by the gl backend, drawing everything anew for each four wavelengths");
  add("--point-lights", &overrides.point_lights,
      "what point takes lights for: samples, the power at each nm; cells, the mean around it; or "
      "better, the more accurate of both");
  add("--bases", &overrides.bases, "linear with so many basis functions, 1 to 16");
  add("--tolerance", &overrides.tolerance,
      "auto: the cheapest method whose ΔE00 against the reference stays below this");
  add("--deadline", &overrides.deadline,
      "auto: the most accurate method that takes no longer than this, such as 2s");
  add("--verify", &overrides.verify,
      "draw the whole picture again by the reference and say how far each pixel is off");
  add("--size", &overrides.size, "WIDTHxHEIGHT in pixels");
  add("--spp", &overrides.spp, "samples per pixel");
  add("--depth", &overrides.depth, "mirror reflections and refractions that a path may take");
  add("--observer", &overrides.observer, observer_meaning);
  add("--shading", &overrides.shading,
      "phong, constant, gouraud or quadratic, where an object has none");
  add("--threads", &overrides.threads, "0: as many as the server has");
  add("--tile-size", &overrides.tile_size, "pixels, a multiple of 8");
  std::string light_meaning =
      "give a light another spectrum, *: all but skies and those that are named after it; ";
  light_meaning += light_words;  // GCC 12 warns wrongly of a sum of the two (its bug 105329).
  add("--light", &overrides.lights, light_meaning);
  options.back().type = "NAME=SPECTRUM";
  declare_development(overrides.development, group, options);
}

void declare_development(DevelopmentOptions& development, const std::string& group,
                         Options& options) {
  const auto add = [&](const char* name, Target target, const char* meaning) {
    options.push_back({.names = name, .target = target, .meaning = meaning, .group = group});
  };
  add("--adapt", &development.adaptation,
      "to the dominant light's white: none, von-kries, bradford, sharp or cmccat2000");
  add("--rgb", &development.rgb,
      "srgb, display-p3, adobe-rgb, prophoto, rec-2020 or cie-rgb, for .png and .exr alike");
  add("--exposure", &development.exposure,
      "stops by which the picture is shown brighter, -30 to 30");
  add("--linear", &development.linear, "a .png without the space's transfer function");
}

void declare_picture_files(OutputOptions& output, Options& options) {
  options.push_back({.names = "-o,--output",
                     .target = &output.files,
                     .meaning = "a .png or .exr; may be given several times",
                     .required = true});
  options.push_back({.names = "--png",
                     .target = &output.png,
                     .meaning = "bits of a .png's samples",
                     .shows_default = true,
                     .choices = {"8", "16"}});
  options.push_back(
      {.names = "--exr",
       .target = &output.exr,
       .meaning = "what an .exr holds: rgb (linear), xyz, spectral or spectral:FROM:TO:STEP nm",
       .shows_default = true});
}

void declare_output(OutputOptions& output, Options& options) {
  declare_picture_files(output, options);
  options.push_back(
      {.names = "--keep-factors",
       .target = &output.factors,
       .meaning = "keep what relighting needs, in FILE or beside the first picture as .factors",
       .type = "[FILE]",
       .value_optional = true});
}

}  // namespace metamer::cli
