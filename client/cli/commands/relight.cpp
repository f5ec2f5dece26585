#include "client/relight/relight.h"

#include <chrono>
#include <set>

#include "client/cli/commands.h"
#include "client/cli/commands/spectra/spectra_input.h"
#include "client/cli/development.h"
#include "client/cli/output/output.h"
#include "client/cli/output/pictures.h"
#include "client/tools/pictures/relit.h"

namespace metamer::cli {
namespace {

using Clock = std::chrono::steady_clock;

struct RelightOptions {
  bool json = false;
  std::string file;                    ///< What --keep-factors wrote.
  std::vector<std::string> lights;     ///< "ceiling=F11", "*=lamp.txt", "key=lamps.sp#warm"
  std::vector<std::string> materials;  ///< "door=red.sp", "door.specular=gloss.txt"
  std::optional<std::string> observer;
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

/// NAME=SPECTRUM, of a name that is known; names may have "=" in them, and so may files.
struct Swap {
  std::string name, spectrum;
};

std::optional<Swap> parse_swap(const std::string& option, const std::string& what,
                               const std::string& text, const std::vector<std::string>& names,
                               std::set<std::string>& named, Report& report) {
  std::optional<Swap> swap;
  for (const std::string& name : names)
    if (text.rfind(name + "=", 0) == 0 && (!swap || name.size() > swap->name.size()))
      swap = {name, text.substr(name.size() + 1)};
  const std::string first = text.substr(0, text.find('='));
  if (first.size() == text.size() || first.empty() || (swap && swap->spectrum.empty())) {
    report.error(option + ": " + metamer::quoted(text) +
                 " is not NAME=SPECTRUM, such as ceiling=F11 or door=paints.sp#red");
    return std::nullopt;
  }
  if (!swap) {
    report.error(option + ": no " + what + " named " + metamer::quoted(first) +
                 did_you_mean(first, names));
    return std::nullopt;
  }
  if (named.insert(swap->name).second) return swap;
  report.error(option + ": " + metamer::quoted(swap->name) + " is named twice");
  return std::nullopt;
}

bool swap_light(const std::string& text, std::set<std::string>& named, v1::SceneFactors& scene,
                Report& report) {
  std::vector<std::string> names = names_of(scene.light());
  names.emplace_back("*");
  const auto swap = parse_swap("--light", "light", text, names, named, report);
  if (!swap) return false;
  const std::string about = "--light: " + metamer::quoted(swap->spectrum);
  if (cie::test_color(swap->spectrum) != nullptr) {
    report.error(about + " is a reflectance, no light");
    return false;
  }
  const auto power = load_for(Use::emission, swap->spectrum, report);
  if (!power) return false;
  if (const std::string fault = client::emission_fault(*power); !fault.empty()) {
    report.error(about + ": " + fault);
    return false;
  }
  client::swap_light(swap->name, *power, scene);
  return true;
}

bool swap_material(const std::string& text, std::set<std::string>& named, const Factors& factors,
                   v1::SceneFactors& scene, Report& report) {
  const auto properties = client::properties_of(scene);
  std::vector<std::string> names;
  for (const auto& [name, property] : properties) names.push_back(name);
  const auto swap = parse_swap("--material", "material", text, names, named, report);
  if (!swap) return false;
  const auto reflectance = load_for(Use::property, swap->spectrum, report);
  if (!reflectance) return false;
  if (const std::string fault = client::reflectance_fault(*reflectance); !fault.empty()) {
    report.error("--material: " + metamer::quoted(swap->spectrum) + ": " + fault);
    return false;
  }
  const client::Property& property = properties.at(swap->name);
  client::swap_reflectance(property, *reflectance, scene);
  if (!client::is_shown(property, factors.tables))
    report.note({.field = {},
                 .file = {},
                 .message = "--material " + metamer::quoted(swap->name) +
                            " has no effect: no pixel shows it"});
  return true;
}

bool swap_all(const RelightOptions& options, const Factors& factors, v1::SceneFactors& scene,
              Report& report) {
  bool good = true;
  std::set<std::string> lights, materials;
  for (const std::string& text : options.lights)
    good = swap_light(text, lights, scene, report) && good;
  for (const std::string& text : options.materials)
    good = swap_material(text, materials, factors, scene, report) && good;
  return good;
}

/// What the picture was made of: in its metadata, beside the plan.
std::string said(const RelightOptions& options) {
  std::string text;
  for (const std::string& light : options.lights) text += "--light " + light + " ";
  for (const std::string& material : options.materials) text += "--material " + material + " ";
  if (options.observer) text += "--observer " + *options.observer;
  return text;
}

/// The plan of a picture that was not rendered again.
bool make_plan(const RelightOptions& options, v1::SceneFactors& scene, v1::Plan& plan,
               Report& report) {
  if (options.observer) {
    const auto observer = load_observer(*options.observer, report);
    if (!observer) return false;
    client::swap_observer(*observer, scene, plan);
  }
  if (const auto applied = apply(options.development, *plan.mutable_development()); !applied)
    return report.error(applied.error().message), false;
  client::plan_relit(scene, plan);
  return true;
}

ExitCode relight_file(const RelightOptions& options, Report& report) {
  const auto start = Clock::now();
  Result<Factors> factors = read_factors(options.file);
  if (!factors) return report.problem(factors.error(), {}), ExitCode::bad_input;
  v1::SceneFactors scene = factors->scene;
  if (!swap_all(options, *factors, scene, report) ||
      !make_plan(options, scene, factors->plan, report))
    return ExitCode::bad_input;

  const auto read = Clock::now();
  const Image image = relight(*factors, scene, client::observer_of(factors->plan, scene));
  const auto lit = Clock::now();
  report.document()["plan"] = to_json(factors->plan);
  report.document()["milliseconds"] = {{"read", milliseconds(start, read)},
                                       {"relight", milliseconds(read, lit)}};
  const client::Pictures pictures{
      image,
      factors->plan,
      &*factors,
      &scene,
      {{"metamer:relight", said(options)}, {"metamer:factors", options.file}}};
  return write_pictures(options.output, pictures, report);
}

ExitCode run(const RelightOptions& options) {
  Report report(options.json);
  const ExitCode fit = check_output(options.output, report);
  if (fit != ExitCode::done) return report.finish(fit);
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
       .meaning = std::string("a light's spectrum, *: that of all lights; ") + light_words,
       .type = "NAME=SPECTRUM"});
  options.push_back({.names = "--material",
                     .target = &values.materials,
                     .meaning = "a material's diffuse spectrum, or NAME.specular=: a CIE test "
                                "colour, a file or FILE#ENTRY",
                     .type = "NAME=SPECTRUM"});
  options.push_back(
      {.names = "--observer", .target = &values.observer, .meaning = observer_meaning});
  declare_development(values.development, "In place of what the picture was rendered with",
                      options);
  declare_picture_files(values.output, options);
  declare_json(values.json, options);
}

}  // namespace

Command commands::relight() {
  return make_command<RelightOptions>(
      "relight", "give a kept picture other light, paint or observer, without a ray", declare, run);
}

}  // namespace metamer::cli
