#include <chrono>
#include <filesystem>

#include "client/cli/commands.h"
#include "client/cli/commands/relight/file_names.h"
#include "client/cli/commands/relight/relighting.h"
#include "client/cli/commands/relight/sheet.h"
#include "client/cli/commands/spectra/spectra_input.h"
#include "client/cli/development.h"
#include "client/cli/output/output.h"
#include "client/cli/output/pictures.h"
#include "client/tools/pictures/relit.h"

namespace metamer::cli {
namespace {

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& one : list) names.push_back(one.name());
  return names;
}

/// Takes the options' observer and development into the plan and the scene.
bool apply_options(const RelightOptions& options, RelightWork& work, Report& report) {
  v1::Plan& plan = work.factors.plan;
  if (options.observer) {
    const auto observer = load_observer(*options.observer, report);
    if (!observer) return false;
    client::swap_observer(*observer, work.scene, plan);
  }
  if (const auto applied = apply(options.development, *plan.mutable_development()); !applied)
    return report.error(applied.error().message), false;
  return true;
}

std::optional<RelightWork> load_work(const RelightOptions& options, Report& report) {
  Result<Factors> factors = read_factors(options.file);
  if (!factors) return report.problem(factors.error(), {}), std::nullopt;
  RelightWork work{.factors = std::move(*factors), .scene = {}, .lights = {}, .materials = {}};
  work.scene = work.factors.scene;
  std::vector<std::string> lights = names_of(work.scene.light()), materials;
  lights.emplace_back("*");
  for (const auto& [name, property] : client::properties_of(work.scene)) materials.push_back(name);
  auto light = variants_of("--light", "light", options.lights, lights, report);
  auto material = variants_of("--material", "material", options.materials, materials, report);
  if (!light || !material || !apply_options(options, work, report)) return std::nullopt;
  work.lights = std::move(*light);
  work.materials = std::move(*material);
  return work;
}

/// What a picture was made of: in its metadata, beside the plan.
std::string said(const RelightOptions& options, const Variant& light, const Variant& material) {
  std::string text;
  for (const Swap& swap : light.swaps) text += "--light " + swap.name + "=" + swap.spectrum + " ";
  for (const Swap& swap : material.swaps)
    text += "--material " + swap.name + "=" + swap.spectrum + " ";
  if (options.observer) text += "--observer " + *options.observer;
  return text;
}

/// All that will be written, as check_output takes it.
Result<OutputOptions> all_files(const RelightOptions& options, const RelightWork& work) {
  OutputOptions all = options.output;
  auto names = file_names(options.output.files, work.lights, work.materials);
  if (!names) return tl::unexpected(std::move(names.error()));
  all.files = std::move(*names);
  if (!options.sheet.empty()) all.files.push_back(options.sheet);
  return all;
}

/// The files of pictures, as write_pictures takes them.
std::vector<client::PictureFiles> picture_files(const RelightOptions& options,
                                                const RelightWork& work,
                                                const std::vector<RelitPicture>& pictures) {
  std::vector<client::PictureFiles> all;
  for (const RelitPicture& one : pictures) {
    const Variant &light = work.lights[one.light], &material = work.materials[one.material];
    std::vector<std::string> files;
    for (const std::string& pattern : options.output.files)
      files.push_back(file_name(pattern, light, material));
    all.push_back({.pictures = {one.image,
                                one.plan,
                                &work.factors,
                                &one.scene,
                                {{"metamer:relight", said(options, light, material)},
                                 {"metamer:factors", options.file}}},
                   .files = std::move(files)});
  }
  return all;
}

/// Makes all pictures, writes those that are wanted, and puts them on the sheet.
ExitCode draw(const RelightOptions& options, const RelightWork& work, Relighting& relighting,
              Report& report) {
  RelightSheet sheet(work, options.sheet_maps, report);
  ExitCode code = ExitCode::done;
  relighting.make([&](const std::vector<RelitPicture>& pictures) {
    for (const RelitPicture& one : pictures) {
      report.document()["plan"] = to_json(one.plan);
      if (work.lights.size() * work.materials.size() > 1)
        report.document()["pictures"].push_back({{"light", work.lights[one.light].label},
                                                 {"material", work.materials[one.material].label}});
      if (!options.sheet.empty()) sheet.add(one);
    }
    if (options.output.files.empty()) return;
    const ExitCode some =
        write_pictures(options.output, picture_files(options, work, pictures), report);
    if (some != ExitCode::done) code = some;
  });
  return options.sheet.empty() || code != ExitCode::done ? code : sheet.write(options.sheet);
}

ExitCode relight_file(const RelightOptions& options, Report& report) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  auto work = load_work(options, report);
  if (!work) return ExitCode::bad_input;
  const auto files = all_files(options, *work);
  if (!files) return report.error("--output: " + files.error().message), ExitCode::bad_input;
  if (const ExitCode fit = check_output(*files, report); fit != ExitCode::done) return fit;
  Relighting relighting(*work, report);
  if (!relighting.check()) return ExitCode::bad_input;
  const double read = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  const ExitCode code = draw(options, *work, relighting, report);
  report.document()["milliseconds"] = {{"read", read}, {"relight", relighting.milliseconds()}};
  return code;
}

ExitCode run(const RelightOptions& options) {
  Report report(options.json);
  if (options.output.files.empty() && options.sheet.empty())
    return refuse("say where to: -o FILE or --sheet FILE", report);
  if (options.sheet.empty() && options.sheet_maps)
    return refuse("--sheet-maps belongs to --sheet FILE", report);
  if (!options.sheet.empty() && std::filesystem::path(options.sheet).extension() != ".png")
    return refuse("--sheet: " + metamer::quoted(options.sheet) + " does not end in .png", report);
  return report.finish(relight_file(options, report));
}

void declare(RelightOptions& values, Options& options) {
  options.push_back({.names = "file",
                     .target = &values.file,
                     .meaning = "what render --keep-factors wrote",
                     .required = true});
  options.push_back(
      {.names = "--light",
       .target = &values.lights,
       .meaning = std::string("a light's spectrum, *: that of all lights, but those that are "
                              "named after it; repeated with one NAME: a picture for "
                              "each; ") +
                  light_words + "; kept: its own",
       .type = "NAME=SPECTRUM"});
  options.push_back({.names = "--material",
                     .target = &values.materials,
                     .meaning =
                         "a material's diffuse spectrum, or NAME.specular=: a CIE test "
                         "colour, FILE, FILE#ENTRY, FILE@percent, kept; repeated with one NAME: "
                         "a picture for each",
                     .type = "NAME=SPECTRUM"});
  options.push_back(
      {.names = "--observer", .target = &values.observer, .meaning = observer_meaning});
  options.push_back({.names = "--sheet",
                     .target = &values.sheet,
                     .meaning = "a .png of all pictures: lights across, materials down, and how "
                                "far each is from the first material's, ΔE00"});
  options.push_back({.names = "--sheet-maps",
                     .target = &values.sheet_maps,
                     .meaning = "on the sheet, below each picture, where it differs from the first "
                                "material's: ΔE00 on one scale"});
  declare_development(values.development, "In place of what the picture was rendered with",
                      options);
  declare_picture_files(values.output, options);
  for (Option& option : options)
    if (option.target == Target(&values.output.files)) {
      option.required = false;
      option.meaning += "; of several pictures with {light}, {material}: 'chair-{light}.png'";
    }
  declare_json(values.json, options);
}

}  // namespace

Command commands::relight() {
  return make_command<RelightOptions>(
      "relight", "give a kept picture other light, paint or observer, without a ray", declare, run);
}

}  // namespace metamer::cli
