#include "client/relight/relight.h"

#include <chrono>
#include <filesystem>

#include "client/cli/commands.h"
#include "client/cli/commands/relight/file_names.h"
#include "client/cli/commands/relight/variants.h"
#include "client/cli/commands/spectra/spectra_input.h"
#include "client/cli/development.h"
#include "client/cli/output/output.h"
#include "client/cli/output/pictures.h"
#include "client/tools/pictures/contact_sheet.h"
#include "client/tools/pictures/relit.h"
#include "client/tools/text/formatted.h"
#include "common/image/compare.h"

namespace metamer::cli {
namespace {

using client::formatted;
using Clock = std::chrono::steady_clock;

struct RelightOptions {
  bool json = false;
  std::string file;                    ///< What --keep-factors wrote.
  std::vector<std::string> lights;     ///< "ceiling=F11", "*=lamp.txt", "key=lamps.sp#warm"
  std::vector<std::string> materials;  ///< "door=red.sp", "door.specular=gloss.txt"
  std::optional<std::string> observer;
  std::string sheet;  ///< A .png of all pictures; empty: none.
  DevelopmentOptions development;
  OutputOptions output;
};

double milliseconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& one : list) names.push_back(one.name());
  return names;
}

/// All that is made of one file of factors.
struct RelightWork {
  Factors factors;  ///< Its plan has the observer and the development that the options say.
  v1::SceneFactors scene;
  std::vector<Variant> lights, materials;
};

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

/// The pictures under one light after the other, and what becomes of them.
class Relighting {
 public:
  Relighting(const RelightOptions& options, RelightWork& work, Report& report)
      : options_(options), work_(work), report_(report), swapper_(work.factors, report) {
    sheet_.cells.resize(work.lights.size() * work.materials.size());
    for (const Variant& light : work.lights) sheet_.lights.push_back(light.label);
    for (const Variant& material : work.materials) sheet_.candidates.push_back(material.label);
  }

  /// Lets every spectrum be read before any picture is written.
  bool check();
  ExitCode draw();
  ExitCode write_sheet();
  double milliseconds_of_light() const { return milliseconds_; }

 private:
  ExitCode draw_one(std::size_t light, std::size_t material);
  void add_to_sheet(std::size_t light, std::size_t material, const Image& image);
  bool several() const { return sheet_.cells.size() > 1; }

  const RelightOptions& options_;
  RelightWork& work_;
  Report& report_;
  Swapper swapper_;
  client::Sheet sheet_;
  Image reference_;  ///< Of the light that is at work, with the first material.
  double milliseconds_ = 0;
};

bool Relighting::check() {
  bool good = true;
  v1::SceneFactors scene = work_.scene;
  for (const Variant& light : work_.lights) good = swapper_.swap_lights(light, scene) && good;
  for (const Variant& material : work_.materials)
    good = swapper_.swap_materials(material, scene) && good;
  return good;
}

ExitCode Relighting::draw() {
  ExitCode code = ExitCode::done;
  for (std::size_t light = 0; light < work_.lights.size(); ++light)
    for (std::size_t material = 0; material < work_.materials.size(); ++material)
      if (const ExitCode one = draw_one(light, material); one != ExitCode::done) code = one;
  return code;
}

ExitCode Relighting::draw_one(std::size_t light, std::size_t material) {
  const Variant &lit = work_.lights[light], &painted = work_.materials[material];
  v1::SceneFactors scene = work_.scene;
  swapper_.swap_lights(lit, scene);
  swapper_.swap_materials(painted, scene);
  client::plan_relit(scene, work_.factors.plan);
  const auto start = Clock::now();
  Image image = relight(work_.factors, scene, client::observer_of(work_.factors.plan, scene));
  milliseconds_ += milliseconds(start, Clock::now());
  Json& document = report_.document();
  document["plan"] = to_json(work_.factors.plan);
  if (several())
    document["pictures"].push_back({{"light", lit.label}, {"material", painted.label}});

  ExitCode code = ExitCode::done;
  if (!options_.output.files.empty()) {
    OutputOptions output = options_.output;
    for (std::string& file : output.files) file = file_name(file, lit, painted);
    const client::Pictures pictures{
        image,
        work_.factors.plan,
        &work_.factors,
        &scene,
        {{"metamer:relight", said(options_, lit, painted)}, {"metamer:factors", options_.file}}};
    code = write_pictures(output, pictures, report_);
  }
  if (!options_.sheet.empty()) {
    if (material == 0) reference_ = image;
    add_to_sheet(light, material, image);
  }
  return code;
}

void Relighting::add_to_sheet(std::size_t light, std::size_t material, const Image& image) {
  const v1::Plan& plan = work_.factors.plan;
  client::SheetCell& cell = sheet_.cells[material * work_.lights.size() + light];
  Image shown = image;
  if (const auto planned = client::planned_developing(plan))
    for (std::size_t i = 0; i < shown.pixels.size(); i += 3) {
      const Xyz adapted = multiply(planned->developing.adaptation,
                                   Xyz{shown.pixels[i], shown.pixels[i + 1], shown.pixels[i + 2]});
      for (std::size_t c = 0; c < 3; ++c) shown.pixels[i + c] = static_cast<float>(adapted[c]);
    }
  cell.picture = client::for_sheet(shown);
  if (material == 0 || plan.source_white_size() != 3) return;
  const Xyz white = {plan.source_white(0), plan.source_white(1), plan.source_white(2)};
  const auto difference = compare(reference_, image, Metric::de00, white);
  if (!difference) return;
  client::set_difference(*difference, cell);
  const ErrorStatistics& differing = *cell.difference;
  report_.document()["pictures"].back()["de00"] = {{"mean", differing.mean},
                                                   {"percentile_95", differing.percentile_95},
                                                   {"maximum", differing.maximum},
                                                   {"share", cell.share}};
  report_.line(formatted(
      "%s under %s: dE00 mean %.2f, 95 %% %.2f, max %.2f from %s, where it "
      "differs (%.3g %% of it)",
      sheet_.candidates[material].c_str(), sheet_.lights[light].c_str(), differing.mean,
      differing.percentile_95, differing.maximum, sheet_.candidates[0].c_str(), 100 * cell.share));
}

ExitCode Relighting::write_sheet() {
  const auto written = client::contact_sheet(sheet_).and_then([&](const Image& image) {
    const auto planned = client::planned_developing(work_.factors.plan);
    Developing developing = planned ? planned->developing : Developing{};
    developing.adaptation = identity3;  // each picture has its own
    return write_image(image, options_.sheet, false, {}, developing);
  });
  if (!written) return report_.problem(written.error(), {}), ExitCode::other;
  report_.document()["files"].push_back(options_.sheet);
  report_.line(options_.sheet);
  return ExitCode::done;
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

ExitCode relight_file(const RelightOptions& options, Report& report) {
  const auto start = Clock::now();
  auto work = load_work(options, report);
  if (!work) return ExitCode::bad_input;
  const auto files = all_files(options, *work);
  if (!files) return report.error("--output: " + files.error().message), ExitCode::bad_input;
  if (const ExitCode fit = check_output(*files, report); fit != ExitCode::done) return fit;
  Relighting relighting(options, *work, report);
  if (!relighting.check()) return ExitCode::bad_input;
  const auto read = Clock::now();
  const ExitCode code = relighting.draw();
  report.document()["milliseconds"] = {{"read", milliseconds(start, read)},
                                       {"relight", relighting.milliseconds_of_light()}};
  if (options.sheet.empty() || code != ExitCode::done) return code;
  return relighting.write_sheet();
}

ExitCode run(const RelightOptions& options) {
  Report report(options.json);
  if (options.output.files.empty() && options.sheet.empty())
    return refuse("say where to: -o FILE or --sheet FILE", report);
  if (!options.sheet.empty() && std::filesystem::path(options.sheet).extension() != ".png")
    return refuse("--sheet: " + metamer::quoted(options.sheet) + " does not end in .png", report);
  return report.finish(relight_file(options, report));
}

void declare(RelightOptions& values, Options& options) {
  options.push_back({.names = "file",
                     .target = &values.file,
                     .meaning = "what render --keep-factors wrote",
                     .required = true});
  options.push_back({.names = "--light",
                     .target = &values.lights,
                     .meaning = std::string("a light's spectrum, *: that of all lights; several "
                                            "for one light: a picture for each; ") +
                                light_words + "; kept: its own",
                     .type = "NAME=SPECTRUM"});
  options.push_back({.names = "--material",
                     .target = &values.materials,
                     .meaning = "a material's diffuse spectrum, or NAME.specular=: a CIE test "
                                "colour, FILE, FILE#ENTRY, FILE@percent, kept; several: a picture "
                                "for each",
                     .type = "NAME=SPECTRUM"});
  options.push_back(
      {.names = "--observer", .target = &values.observer, .meaning = observer_meaning});
  options.push_back({.names = "--sheet",
                     .target = &values.sheet,
                     .meaning = "a .png of all pictures: lights across, materials down, and how "
                                "far each is from the first material's, ΔE00"});
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
