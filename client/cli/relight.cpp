#include "client/relight/relight.h"

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "client/cli/commands.h"
#include "client/cli/development.h"
#include "client/cli/output.h"
#include "client/cli/pictures.h"
#include "client/cli/spectra_input.h"
#include "common/scene/names.h"
#include "common/scene/settings.h"

namespace metamer::cli {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double, std::milli>(to - from).count();
}

void set(const Spectrum& spectrum, v1::SampledSpectrum& to) {
  to.mutable_nm()->Assign(spectrum.nm.begin(), spectrum.nm.end());
  to.mutable_values()->Assign(spectrum.values.begin(), spectrum.values.end());
}

struct Swap {
  std::string name, spectrum;
  std::optional<std::string> entry;  ///< Of a file with several spectra.
};

/// NAME=SPECTRUM or NAME=FILE#ENTRY; the first "=" separates, as a file's name may have one.
std::optional<Swap> parse_swap(const std::string& option, const std::string& text, Report& report) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size()) {
    report.error(option + ": \"" + text +
                 "\" is not NAME=SPECTRUM, such as ceiling=F11 or door=paints.sp#red");
    return std::nullopt;
  }
  Swap swap{text.substr(0, equals), text.substr(equals + 1), {}};
  std::error_code error;
  const std::size_t hash = swap.spectrum.rfind('#');
  if (hash != std::string::npos && !std::filesystem::exists(swap.spectrum, error)) {
    swap.entry = swap.spectrum.substr(hash + 1);
    swap.spectrum.resize(hash);
  }
  return swap;
}

std::optional<Spectrum> load(const Swap& swap, const char* kind, Report& report) {
  SpectraOptions options;
  options.kind = kind;
  options.entry = swap.entry;
  const auto loaded = load_one(options, swap.spectrum, report);
  return loaded ? std::optional(loaded->spectrum) : std::nullopt;
}

template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto& one : list) names.push_back(one.name());
  return names;
}

bool swap_light(const std::string& text, v1::SceneFactors& scene, Report& report) {
  const auto swap = parse_swap("--light", text, report);
  if (!swap) return false;
  const auto power = load(*swap, "emission", report);
  if (!power) return false;
  if (*std::min_element(power->values.begin(), power->values.end()) < 0) {
    report.error("--light: \"" + swap->spectrum + "\": a light has no power below 0");
    return false;
  }
  bool found = false;
  for (auto& light : *scene.mutable_light()) {
    if (swap->name != "*" && swap->name != light.name()) continue;
    set(*power, *light.mutable_power());
    found = true;
  }
  if (!found)
    report.error("--light: no light named \"" + swap->name + "\"" +
                 did_you_mean(swap->name, names_of(scene.light())));
  return found;
}

/// What of a material NAME or NAME.specular means; null where there is none.
v1::SampledSpectrum* find_property(const std::string& name, v1::SceneFactors& scene) {
  for (auto& material : *scene.mutable_material()) {
    if (name == material.name() || name == material.name() + ".diffuse")
      return material.mutable_diffuse();
    if (name == material.name() + ".specular") return material.mutable_specular();
  }
  return nullptr;
}

bool swap_material(const std::string& text, v1::SceneFactors& scene, Report& report) {
  const auto swap = parse_swap("--material", text, report);
  if (!swap) return false;
  v1::SampledSpectrum* property = find_property(swap->name, scene);
  if (!property) {
    report.error("--material: no material named \"" + swap->name + "\"" +
                 did_you_mean(swap->name, names_of(scene.material())));
    return false;
  }
  const auto reflectance = load(*swap, "reflectance", report);
  if (!reflectance) return false;
  const auto [least, most] =
      std::minmax_element(reflectance->values.begin(), reflectance->values.end());
  if (*least < 0 || *most > 1) {
    const auto at =
        static_cast<std::size_t>((*least < 0 ? least : most) - reflectance->values.begin());
    char number[64];
    std::snprintf(number, sizeof number, "%g at %g nm", reflectance->values[at],
                  reflectance->nm[at]);
    report.error("--material: \"" + swap->spectrum + "\": a reflectance lies in 0..1 (it is " +
                 number + ")");
    return false;
  }
  set(*reflectance, *property);
  return true;
}

bool swap_all(const RelightOptions& options, v1::SceneFactors& scene, Report& report) {
  bool good = true;
  for (const std::string& text : options.lights) good = swap_light(text, scene, report) && good;
  for (const std::string& text : options.materials)
    good = swap_material(text, scene, report) && good;
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
bool make_plan(const RelightOptions& options, const v1::SceneFactors& scene, v1::Plan& plan,
               Report& report) {
  if (options.observer) {
    const auto observer = observer_of(*options.observer);
    if (!observer) return report.error(observer.error().message), false;
    plan.set_observer(*observer == cie::Observer::cie_1931_2deg ? v1::CIE_1931_2DEG
                                                                : v1::CIE_1964_10DEG);
  }
  if (const auto applied = apply(options.development, *plan.mutable_development()); !applied)
    return report.error(applied.error().message), false;
  plan.clear_source_white();
  if (const auto white = source_white(scene, to_observer(plan.observer())))
    for (const double value : *white) plan.add_source_white(value);
  plan.clear_auto_();
  plan.mutable_method()->mutable_exact();
  return true;
}

ExitCode relight_file(const RelightOptions& options, Report& report) {
  const auto start = Clock::now();
  Result<Factors> factors = read_factors(options.file);
  if (!factors) return report.problem(factors.error(), {}), ExitCode::bad_input;
  v1::SceneFactors scene = factors->scene;
  if (!swap_all(options, scene, report) || !make_plan(options, scene, factors->plan, report))
    return ExitCode::bad_input;

  const auto read = Clock::now();
  const Image image = relight(*factors, scene, to_observer(factors->plan.observer()));
  const auto lit = Clock::now();
  report.document()["plan"] = to_json(factors->plan);
  report.document()["milliseconds"] = {{"read", milliseconds(start, read)},
                                       {"relight", milliseconds(read, lit)}};
  const Pictures pictures{image,
                          factors->plan,
                          &*factors,
                          &scene,
                          {{"metamer:relight", said(options)}, {"metamer:factors", options.file}}};
  return write_pictures(options.output, pictures, report);
}

}  // namespace

ExitCode relight(const RelightOptions& options) {
  Report report(options.json);
  if (!check_output(options.output, report)) return report.finish(ExitCode::bad_input);
  return report.finish(relight_file(options, report));
}

}  // namespace metamer::cli
