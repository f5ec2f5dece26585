#include "client/cli/overrides.h"

#include <google/protobuf/descriptor.h>

#include <charconv>
#include <set>
#include <string_view>

#include "client/cli/development.h"
#include "client/tools/scene/light_names.h"
#include "client/tools/scene/light_words.h"
#include "client/tools/scene/observers.h"
#include "client/tools/scene/words.h"
#include "client/tools/spectra/spectrum_word.h"
#include "common/scene/schema.h"

namespace metamer::cli {
namespace {

using client::Look;
using client::Replaced;

template <class T>
std::optional<T> parse_number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t end = text.find(separator);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

/// All the parts as numbers; nothing when one is none.
template <class T>
std::optional<std::vector<T>> parse_numbers(std::string_view text, char separator) {
  std::vector<T> numbers;
  for (std::string_view part : split(text, separator)) {
    const std::optional<T> number = parse_number<T>(part);
    if (!number) return std::nullopt;
    numbers.push_back(*number);
  }
  return numbers;
}

/// Options that exclude each other.
Result<void> check_method(const Overrides& overrides) {
  const bool positions = overrides.samples || overrides.wavelengths || overrides.fitted;
  if (overrides.bases && (positions || overrides.method.value_or("linear") != "linear"))
    return problem("--bases is for --method linear");
  if (overrides.samples && overrides.wavelengths)
    return problem("--samples and --wavelengths exclude each other");
  if (overrides.fitted && (overrides.samples || overrides.wavelengths))
    return problem("--fitted excludes --samples and --wavelengths");
  return {};
}

Result<void> add_method(const Overrides& overrides, Look& look) {
  if (Result<void> checked = check_method(overrides); !checked) return checked;
  if (overrides.method) {
    const bool positions = overrides.samples || overrides.wavelengths || overrides.fitted;
    const auto* field = v1::Method::descriptor()->FindFieldByName(*overrides.method);
    if (field == nullptr)
      return tl::unexpected(
          metamer::unknown_name("--method: no method named \"" + *overrides.method + "\"",
                                *overrides.method, field_names(*v1::Method::descriptor())));
    if (positions && *overrides.method != "point")
      return problem("--method " + *overrides.method + " has no wavelengths to choose");
    if (*overrides.method == "auto") {
      look.settings.mutable_goal();
      look.set("goal", "--method");
      return {};
    }
    v1::Method& method = *look.settings.mutable_method();
    method.GetReflection()->MutableMessage(&method, field);
    if (!positions) look.mask.add_paths("method." + field->name());
    look.replaced.push_back({"settings.method", "--method"});
  }
  if (overrides.bases) {
    look.settings.mutable_method()->mutable_linear()->set_bases(*overrides.bases);
    look.set("method.linear.bases", "--bases");
  }
  return {};
}

/// Positions ask for point sampling by themselves, and replace the scene's as a whole: a step of
/// the scene does not go with a range from here.
void set_point(const v1::Point& point, const char* option, Look& look) {
  *look.settings.mutable_method()->mutable_point() = point;
  for (const std::string& field : field_names(*v1::Point::descriptor()))
    look.mask.add_paths("method.point." + field);
  look.replaced.push_back({"settings.method", option});
}

Result<void> add_positions(const Overrides& overrides, Look& look) {
  v1::Point point;
  if (overrides.samples) {
    const auto numbers = parse_numbers<double>(*overrides.samples, ':');
    if (!numbers || numbers->size() != 3)
      return problem("--samples: \"" + *overrides.samples +
                     "\" is not FROM:TO:STEP, such as 400:700:5");
    point.set_from((*numbers)[0]);
    point.set_to((*numbers)[1]);
    point.set_step((*numbers)[2]);
    set_point(point, "--samples", look);
  }
  if (overrides.wavelengths) {
    const auto numbers = parse_numbers<double>(*overrides.wavelengths, ',');
    if (!numbers)
      return problem("--wavelengths: \"" + *overrides.wavelengths +
                     "\" is not a list of numbers, such as 400,436,546,700");
    point.mutable_wavelengths()->Add(numbers->begin(), numbers->end());
    set_point(point, "--wavelengths", look);
  }
  if (overrides.fitted) {
    point.set_fitted(*overrides.fitted);
    set_point(point, "--fitted", look);
  }
  return {};
}

/// For a method that is point sampling, or will be as there is neither another nor a goal.
Result<void> check_point(const v1::Settings& settings, const std::string& option) {
  const v1::Method& method = settings.method();
  const bool unset = method.method_case() == v1::Method::METHOD_NOT_SET;
  if (method.has_point() || (unset && !method.has_auto_() && !settings.has_goal())) return {};
  return problem(option + " is for --method point");
}

Result<void> add_multi_pass(const Overrides& overrides, Look& look) {
  if (!overrides.multi_pass) return {};
  if (Result<void> checked = check_point(look.settings, "--multi-pass"); !checked) return checked;
  look.settings.mutable_method()->mutable_point()->set_multi_pass(true);
  look.set("method.point.multi_pass", "--multi-pass");
  return {};
}

Result<void> add_point_lights(const Overrides& overrides, Look& look) {
  if (!overrides.point_lights) return {};
  if (Result<void> checked = check_point(look.settings, "--point-lights"); !checked) return checked;
  const auto lights = client::value_named(*overrides.point_lights, "way to take lights",
                                          *v1::Point::Lights_descriptor());
  if (!lights) return problem("--point-lights: " + lights.error().message);
  look.settings.mutable_method()->mutable_point()->set_lights(
      static_cast<v1::Point::Lights>(*lights));
  look.set("method.point.lights", "--point-lights");
  return {};
}

/// "2s", "2", "500ms" or "1min".
std::optional<double> parse_seconds(std::string_view text) {
  double unit = 1;
  for (const auto& [word, seconds] : {std::pair{"ms", 1e-3}, {"min", 60.0}, {"s", 1.0}}) {
    if (!text.ends_with(word)) continue;
    text.remove_suffix(std::string_view(word).size());
    unit = seconds;
    break;
  }
  const auto number = parse_number<double>(text);
  return number ? std::optional(unit * *number) : std::nullopt;
}

/// A goal takes the place of a method by itself.
Result<void> add_goal(const Overrides& overrides, Look& look) {
  if (!overrides.tolerance && !overrides.deadline) return {};
  const char* option = overrides.tolerance ? "--tolerance" : "--deadline";
  if (overrides.tolerance && overrides.deadline)
    return problem("--tolerance and --deadline exclude each other");
  if (overrides.method.value_or("auto") != "auto" || overrides.samples || overrides.wavelengths ||
      overrides.bases || overrides.fitted || overrides.multi_pass || overrides.point_lights)
    return problem(std::string(option) + " is for --method auto");
  v1::Goal& goal = *look.settings.mutable_goal();
  if (overrides.tolerance) {
    goal.set_tolerance(*overrides.tolerance);
  } else {
    const std::optional<double> seconds = parse_seconds(*overrides.deadline);
    if (!seconds)
      return problem("--deadline: \"" + *overrides.deadline + "\" is not a time, such as 2s");
    goal.set_deadline(*seconds);
  }
  look.set("goal", option);
  return {};
}

Result<void> add_size(const Overrides& overrides, Look& look) {
  if (!overrides.size) return {};
  const auto numbers = parse_numbers<std::uint32_t>(*overrides.size, 'x');
  if (!numbers || numbers->size() != 2)
    return problem("--size: \"" + *overrides.size + "\" is not WIDTHxHEIGHT, such as 640x480");
  look.settings.set_width((*numbers)[0]);
  look.settings.set_height((*numbers)[1]);
  look.set("width", "--size");
  look.set("height", "--size");
  return {};
}

Result<void> add_words(const Overrides& overrides, Look& look) {
  if (overrides.observer) {
    const auto observer = client::choose_observer(*overrides.observer);
    if (!observer) return problem("--observer: " + observer.error().message);
    look.settings.set_observer(observer->cie);
    look.settings.set_observer_file(observer->file);
    look.mask.add_paths("observer");
    look.set("observer_file", "--observer");
    look.replaced.back().file = observer->file;
  }
  if (overrides.backend) {
    const auto backend =
        client::value_named(*overrides.backend, "backend", *v1::Backend_descriptor());
    if (!backend) return problem("--backend: " + backend.error().message);
    look.settings.set_backend(static_cast<v1::Backend>(*backend));
    look.set("backend", "--backend");
  }
  if (overrides.shading) {
    const auto shading =
        client::value_named(*overrides.shading, "shading", *v1::Shading_descriptor());
    if (!shading) return problem("--shading: " + shading.error().message);
    look.settings.set_shading(static_cast<v1::Shading>(*shading));
    look.set("shading", "--shading");
  }
  return {};
}

Result<void> add_development(const Overrides& overrides, Look& look) {
  const DevelopmentOptions& options = overrides.development;
  if (!options.adaptation && !options.rgb && !options.linear && !options.exposure) return {};
  const auto given = apply(options, *look.settings.mutable_development());
  if (!given) return tl::unexpected(given.error());
  if (options.adaptation) look.mask.add_paths("development.adaptation");
  if (options.exposure) look.mask.add_paths("development.exposure");
  if (options.linear) look.mask.add_paths("development.linear");
  if (!options.rgb) return {};
  look.mask.add_paths("development.rgb_space");
  // Only primaries can be wrong, and --rgb puts them aside.
  look.replaced.push_back({"settings.development", "--rgb"});
  return {};
}

/// Where NAME=SPECTRUM is parted: before a file, which may have "=" in its name, else at the last
/// one, as the names of lights may have some and those of illuminants have none.
std::size_t parting(const std::string& text) {
  for (std::size_t at = text.find('='); at != std::string::npos; at = text.find('=', at + 1)) {
    const auto word = client::parse_spectrum_word(text.substr(at + 1));
    if (word && word->is_file) return at;
  }
  return text.rfind('=');
}

Result<void> add_lights(const Overrides& overrides, Look& look) {
  std::set<std::string> named;
  for (const std::string& text : overrides.lights) {
    const std::size_t equals = parting(text);
    const std::string name = text.substr(0, equals);
    if (!named.insert(name).second) return problem("--light: " + quoted(name) + " is named twice");
    if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
      return problem("--light: \"" + text + "\" is not NAME=SPECTRUM, such as ceiling=A");
    auto light = client::light_of_word(text.substr(equals + 1));
    if (!light) return problem("--light: " + light.error().message);
    client::LightChange& change = look.lights.emplace_back();
    change.light.set_name(name);
    *change.light.mutable_spectrum() = std::move(light->spectrum);
    change.by = "--light";
    change.file = std::move(light->file);
  }
  return {};
}

Result<void> add_numbers(const Overrides& overrides, Look& look) {
  if (overrides.verify) {
    look.settings.set_verify(true);
    look.set("verify", "--verify");
  }
  if (overrides.spp) {
    look.settings.set_spp(*overrides.spp);
    look.set("spp", "--spp");
  }
  if (overrides.depth) {
    look.settings.set_depth(*overrides.depth);
    look.set("depth", "--depth");
  }
  if (overrides.threads) {
    look.settings.set_threads(*overrides.threads);
    look.set("threads", "--threads");
  }
  if (overrides.tile_size) {
    look.settings.set_tile_size(*overrides.tile_size);
    look.set("tile_size", "--tile-size");
  }
  return {};
}

}  // namespace

Result<Look> look_of(const Overrides& overrides) {
  Look look;
  for (const auto add : {add_method, add_positions, add_multi_pass, add_point_lights, add_goal,
                         add_size, add_words, add_development, add_lights, add_numbers})
    if (Result<void> added = add(overrides, look); !added)
      return tl::unexpected(std::move(added.error()));
  return look;
}

namespace {

Result<std::vector<Replaced>> apply_named_look(const std::optional<std::string>& name,
                                               v1::Scene& scene) {
  if (!name) return std::vector<Replaced>();
  const Result<Look> look = client::look_named(scene, *name);
  if (!look) return problem("--look: " + look.error().message);
  return client::apply(*look, scene);
}

/// Every --light has a light.
Result<void> check_lights(const Look& look, const v1::Scene& scene) {
  std::vector<std::string> named, lights;
  for (const client::LightChange& change : look.lights) named.push_back(change.light.name());
  for (const v1::Light& light : scene.light()) lights.push_back(light.name());
  const std::string fault = client::no_effect(named, lights);
  return fault.empty() ? Result<void>() : problem("--light: " + fault);
}

}  // namespace

Result<std::vector<Replaced>> apply(const Overrides& overrides, v1::Scene& scene) {
  auto all_replaced = apply_named_look(overrides.look, scene);
  if (!all_replaced) return all_replaced;
  Result<Look> look = look_of(overrides);
  if (!look) return tl::unexpected(std::move(look.error()));
  const bool chosen =
      overrides.method || overrides.samples || overrides.wavelengths || overrides.fitted;
  for (const auto& [given, option] :
       {std::pair{overrides.multi_pass, "--multi-pass"},
        std::pair{overrides.point_lights.has_value(), "--point-lights"}})
    if (given && !chosen)
      if (Result<void> checked = check_point(scene.settings(), option); !checked)
        return tl::unexpected(std::move(checked.error()));
  auto replaced = client::apply(*look, scene);
  // What can be wrong by now is a light's name.
  if (!replaced) return problem("--light: " + replaced.error().message);
  if (const auto checked = check_lights(*look, scene); !checked)
    return tl::unexpected(checked.error());
  all_replaced->insert(all_replaced->end(), replaced->begin(), replaced->end());
  return all_replaced;
}

bool choose_a_method(const Overrides& overrides) {
  return overrides.method || overrides.samples || overrides.wavelengths || overrides.fitted ||
         overrides.multi_pass || overrides.point_lights || overrides.bases || overrides.tolerance ||
         overrides.deadline;
}

}  // namespace metamer::cli
