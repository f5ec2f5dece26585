#include "client/cli/commands/relight/variants.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <utility>

#include "client/cli/commands/spectra/spectra_input.h"
#include "client/relight/relight.h"
#include "client/relight/reradiated_lights.h"
#include "client/relight/scene_sources.h"
#include "client/tools/pictures/relit.h"
#include "client/tools/scene/light_names.h"
#include "client/tools/spectra/spectrum_word.h"

namespace metamer::cli {
namespace {

std::optional<Swap> parse_swap(const std::string& option, const std::string& what,
                               const std::string& text, const std::vector<std::string>& names,
                               Report& report) {
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
  if (!swap)
    report.error(option + ": no " + what + " named " + metamer::quoted(first) +
                 did_you_mean(first, names));
  return swap;
}

/// A spectrum as people call it: a file by its name without folder and ending.
std::string label_of(const std::string& word) {
  const auto parsed = client::parse_spectrum_word(word);
  if (!parsed || !parsed->is_file) return word;
  const std::string stem = std::filesystem::path(parsed->name).stem().string();
  return parsed->entry ? stem + " " + *parsed->entry : stem;
}

/// The spectra of each name, in the order in which names first appear.
using Given = std::vector<std::pair<std::string, std::vector<std::string>>>;

bool has_all_lights(const Given& given) {
  return std::any_of(given.begin(), given.end(),
                     [](const auto& one) { return one.first == client::all_lights; });
}

/// A label names what differs between pictures, and what else is given where it could be taken for
/// that of all lights: "D65, lamp left=F11".
Variant variant_of(const Given& given, std::size_t i, std::size_t count) {
  Variant variant;
  std::vector<std::string> labels;
  std::string others;
  for (const auto& [name, spectra] : given) {
    const std::string& spectrum = spectra[spectra.size() == 1 ? 0 : i];
    variant.swaps.push_back({name, spectrum});
    std::string label = label_of(spectrum);
    if (has_all_lights(given) && name != client::all_lights)
      others += ", " + name + "=" + label;
    else if ((spectra.size() == count || name == client::all_lights) &&
             std::find(labels.begin(), labels.end(), label) == labels.end())
      labels.push_back(std::move(label));
  }
  for (const std::string& label : labels)
    variant.label += (variant.label.empty() ? "" : "+") + label;
  if (labels.empty()) variant.label = kept_word;
  variant.label += others;
  return variant;
}

/// Lights that are given a spectrum which later ones leave no light: none of the pictures would be
/// what its label says.
std::string fault_of(const Given& given, const std::vector<std::string>& names) {
  if (!has_all_lights(given)) return {};
  std::vector<std::string> said, lights;
  for (const auto& one : given) said.push_back(one.first);
  std::copy_if(names.begin(), names.end(), std::back_inserter(lights),
               [](const std::string& name) { return name != client::all_lights; });
  return client::no_effect(said, lights);
}

}  // namespace

std::optional<std::vector<Variant>> variants_of(const std::string& option, const std::string& what,
                                                const std::vector<std::string>& texts,
                                                const std::vector<std::string>& names,
                                                Report& report) {
  Given given;
  bool good = true;
  std::size_t count = 1;
  for (const std::string& text : texts) {
    const auto swap = parse_swap(option, what, text, names, report);
    good = good && swap;
    if (!swap) continue;
    auto found = std::find_if(given.begin(), given.end(),
                              [&](const auto& one) { return one.first == swap->name; });
    if (found == given.end()) found = given.insert(found, {swap->name, {}});
    found->second.push_back(swap->spectrum);
    count = std::max(count, found->second.size());
  }
  for (const auto& [name, spectra] : given) {
    if (spectra.size() == 1 || spectra.size() == count) continue;
    report.error(option + ": " + metamer::quoted(name) + " is given " +
                 std::to_string(spectra.size()) + " spectra and another " + std::to_string(count) +
                 ": each picture needs one, or all the same");
    good = false;
  }
  if (const std::string fault = fault_of(given, names); good && !fault.empty()) {
    report.error(option + ": " + fault);
    good = false;
  }
  if (!good) return std::nullopt;
  std::vector<Variant> variants;
  for (std::size_t i = 0; i < count; ++i) variants.push_back(variant_of(given, i, count));
  return variants;
}

const Spectrum* Swapper::load(Use use, const std::string& word, const v1::SceneFactors& scene) {
  const auto [entry, is_new] = loaded_.try_emplace({use, word});
  std::optional<Spectrum>& spectrum = entry->second;
  if (is_new) {
    const std::string about =
        (use == Use::emission ? "--light: " : "--material: ") + metamer::quoted(word);
    const bool paint_as_light = use == Use::emission && cie::test_color(word) != nullptr;
    if (paint_as_light)
      report_.error(about + " is a reflectance, no light");
    else
      spectrum = load_for(use, word, report_);
    const std::string fault = !spectrum              ? std::string()
                              : use == Use::emission ? client::emission_fault(*spectrum)
                                                     : client::reflectance_fault(*spectrum);
    if (!fault.empty()) {
      report_.error(about + ": " + fault);
      spectrum.reset();
    }
    if (spectrum) tell_unseen(use, word, *spectrum, scene);
  }
  return spectrum ? &*spectrum : nullptr;
}

void Swapper::tell_unseen(Use use, const std::string& word, const Spectrum& spectrum,
                          const v1::SceneFactors& scene) {
  const Observer observer = client::observer_of(factors_.plan, scene);
  if (use == Use::emission) {
    const bool seen = CumulativeLight(word, spectrum, observer).any();
    return tell_ends(
        word,
        seen ? ends_of_light(spectrum, observer) : "stays dark: the observer sees nothing of it",
        report_);
  }
  std::vector<CumulativeLight> lights;
  for (const auto& light : scene.light())
    lights.emplace_back(light.name(), to_spectrum(light.power()), observer);
  tell_ends(word, ends_of_property(spectrum, lights), report_);
}

bool Swapper::swap_lights(const Variant& variant, v1::SceneFactors& scene) {
  bool good = true;
  std::vector<std::string> names;
  for (const Swap& swap : variant.swaps) names.push_back(swap.name);
  for (const auto& light : factors_.scene.light()) {
    const auto by = client::name_for(light.name(), names);
    if (!by || variant.swaps[*by].spectrum == kept_word) continue;
    const Spectrum* power = load(Use::emission, variant.swaps[*by].spectrum, scene);
    good = good && power != nullptr;
    if (power != nullptr) client::swap_light(light.name(), *power, scene);
  }
  return good;
}

bool Swapper::swap_materials(const Variant& variant, v1::SceneFactors& scene) {
  const auto properties = client::properties_of(scene);
  bool good = true;
  for (const Swap& swap : variant.swaps) {
    if (swap.spectrum == kept_word) continue;
    const Spectrum* reflectance = load(Use::property, swap.spectrum, scene);
    good = good && reflectance != nullptr;
    if (reflectance == nullptr) continue;
    const client::Property& property = properties.at(swap.name);
    client::swap_reflectance(property, *reflectance, scene);
    if (client::is_shown(property, factors_.tables) || !told_.insert(swap.name).second) continue;
    report_.note({.field = {},
                  .file = {},
                  .message = "--material " + metamer::quoted(swap.name) +
                             " has no effect: no pixel shows it"});
  }
  if (const std::string fault = client::energy_fault(scene); good && !fault.empty()) {
    report_.error("--material: " + fault);
    return false;
  }
  return good;
}

}  // namespace metamer::cli
