#include "client/cli/overrides.h"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <charconv>
#include <set>
#include <string_view>

#include "client/cli/development.h"
#include "common/scene/schema.h"

namespace metamer::cli {
namespace {

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

Result<void> apply_method(const Overrides& overrides, v1::Settings& settings,
                          std::vector<Replaced>& replaced) {
  const bool positions = overrides.samples || overrides.wavelengths || overrides.fitted;
  if (overrides.bases && (positions || overrides.method.value_or("linear") != "linear"))
    return problem("--bases is for --method linear");
  if (overrides.samples && overrides.wavelengths)
    return problem("--samples and --wavelengths exclude each other");
  if (overrides.fitted && (overrides.samples || overrides.wavelengths))
    return problem("--fitted excludes --samples and --wavelengths");

  // Choose the method; positions ask for point sampling by themselves.
  if (overrides.method) {
    const auto* field = v1::Method::descriptor()->FindFieldByName(*overrides.method);
    if (field == nullptr)
      return problem("--method: no method named \"" + *overrides.method + "\"" +
                     did_you_mean(*overrides.method, field_names(*v1::Method::descriptor())));
    if (positions && *overrides.method != "point")
      return problem("--method " + *overrides.method + " has no wavelengths to choose");
    v1::Method& method = *settings.mutable_method();
    method.GetReflection()->MutableMessage(&method, field);
    replaced.push_back({"settings.method", "--method"});
  }

  if (overrides.bases) {
    settings.mutable_method()->mutable_linear()->set_bases(*overrides.bases);
    replaced.push_back({"settings.method.linear.bases", "--bases"});
  }

  // Replace the positions as a whole: a step of the scene does not go with a range from here.
  if (overrides.samples) {
    const auto numbers = parse_numbers<double>(*overrides.samples, ':');
    if (!numbers || numbers->size() != 3)
      return problem("--samples: \"" + *overrides.samples +
                     "\" is not FROM:TO:STEP, such as 400:700:5");
    v1::Point* point = settings.mutable_method()->mutable_point();
    point->Clear();
    point->set_from((*numbers)[0]);
    point->set_to((*numbers)[1]);
    point->set_step((*numbers)[2]);
    replaced.push_back({"settings.method", "--samples"});
  }
  if (overrides.wavelengths) {
    const auto numbers = parse_numbers<double>(*overrides.wavelengths, ',');
    if (!numbers)
      return problem("--wavelengths: \"" + *overrides.wavelengths +
                     "\" is not a list of numbers, such as 400,436,546,700");
    v1::Point* point = settings.mutable_method()->mutable_point();
    point->Clear();
    for (const double nm : *numbers) point->add_wavelengths(nm);
    replaced.push_back({"settings.method", "--wavelengths"});
  }
  if (overrides.fitted) {
    v1::Point* point = settings.mutable_method()->mutable_point();
    point->Clear();
    point->set_fitted(*overrides.fitted);
    replaced.push_back({"settings.method", "--fitted"});
  }
  if (overrides.multi_pass) {
    if (settings.method().method_case() != v1::Method::METHOD_NOT_SET &&
        !settings.method().has_point())
      return problem("--multi-pass is for --method point");
    settings.mutable_method()->mutable_point()->set_multi_pass(true);
    replaced.push_back({"settings.method.point.multi_pass", "--multi-pass"});
  }
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

/// A goal asks for the method `auto` by itself.
Result<void> apply_goal(const Overrides& overrides, v1::Settings& settings,
                        std::vector<Replaced>& replaced) {
  if (!overrides.tolerance && !overrides.deadline) return {};
  const char* option = overrides.tolerance ? "--tolerance" : "--deadline";
  if (overrides.tolerance && overrides.deadline)
    return problem("--tolerance and --deadline exclude each other");
  if (overrides.method.value_or("auto") != "auto" || overrides.samples || overrides.wavelengths ||
      overrides.bases || overrides.fitted || overrides.multi_pass)
    return problem(std::string(option) + " is for --method auto");
  v1::Auto& goal = *settings.mutable_method()->mutable_auto_();
  if (overrides.tolerance) {
    goal.set_tolerance(*overrides.tolerance);
  } else {
    const std::optional<double> seconds = parse_seconds(*overrides.deadline);
    if (!seconds)
      return problem("--deadline: \"" + *overrides.deadline + "\" is not a time, such as 2s");
    goal.set_deadline(*seconds);
  }
  replaced.push_back({"settings.method", option});
  return {};
}

Result<void> apply_size(const std::string& size, v1::Settings& settings,
                        std::vector<Replaced>& replaced) {
  const auto numbers = parse_numbers<std::uint32_t>(size, 'x');
  if (!numbers || numbers->size() != 2)
    return problem("--size: \"" + size + "\" is not WIDTHxHEIGHT, such as 640x480");
  settings.set_width((*numbers)[0]);
  settings.set_height((*numbers)[1]);
  replaced.push_back({"settings.width", "--size"});
  replaced.push_back({"settings.height", "--size"});
  return {};
}

Result<void> apply_observer(const std::string& observer, v1::Settings& settings) {
  if (observer == "cie-1931-2deg") {
    settings.set_observer(v1::CIE_1931_2DEG);
  } else if (observer == "cie-1964-10deg") {
    settings.set_observer(v1::CIE_1964_10DEG);
  } else {
    return problem("--observer: no observer named \"" + observer + "\"" +
                   did_you_mean(observer, {"cie-1931-2deg", "cie-1964-10deg"}));
  }
  return {};
}

/// The value of an enum whose name the option gives, in small letters.
Result<int> value_named(const std::string& name, const char* what,
                        const google::protobuf::EnumDescriptor& values) {
  std::vector<std::string> names;
  for (int i = 0; i < values.value_count(); ++i) {
    std::string own = values.value(i)->name();
    std::transform(own.begin(), own.end(), own.begin(), [](char c) {
      return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    });
    if (own == name) return values.value(i)->number();
    names.push_back(std::move(own));
  }
  std::string choices;
  for (const std::string& own : names) choices += (choices.empty() ? "" : ", ") + own;
  const std::string hint = did_you_mean(name, names);
  return problem(std::string("--") + what + ": no " + what + " named \"" + name + "\"" +
                 (hint.empty() ? "; there are " + choices : hint));
}

Result<void> apply_shading(const std::string& shading, v1::Settings& settings,
                           std::vector<Replaced>& replaced) {
  return value_named(shading, "shading", *v1::Shading_descriptor()).map([&](int value) {
    settings.set_shading(static_cast<v1::Shading>(value));
    replaced.push_back({"settings.shading", "--shading"});
  });
}

Result<void> apply_backend(const std::string& backend, v1::Settings& settings,
                           std::vector<Replaced>& replaced) {
  return value_named(backend, "backend", *v1::Backend_descriptor()).map([&](int value) {
    settings.set_backend(static_cast<v1::Backend>(value));
    replaced.push_back({"settings.backend", "--backend"});
  });
}

Result<void> apply_development(const DevelopmentOptions& options, v1::Settings& settings,
                               std::vector<Replaced>& replaced) {
  if (!options.adaptation && !options.rgb && !options.linear) return {};
  return apply(options, *settings.mutable_development())
      .map([&](const std::vector<std::string>& given) {
        // Only primaries can be wrong, and --rgb puts them aside.
        for (const std::string& option : given)
          if (option == "--rgb") replaced.push_back({"settings.development", option});
      });
}

void apply_numbers(const Overrides& overrides, v1::Settings& settings,
                   std::vector<Replaced>& replaced) {
  if (overrides.spp) {
    settings.set_spp(*overrides.spp);
    replaced.push_back({"settings.spp", "--spp"});
  }
  if (overrides.depth) {
    settings.set_depth(*overrides.depth);
    replaced.push_back({"settings.depth", "--depth"});
  }
  if (overrides.threads) {
    settings.set_threads(*overrides.threads);
    replaced.push_back({"settings.threads", "--threads"});
  }
  if (overrides.tile_size) {
    settings.set_tile_size(*overrides.tile_size);
    replaced.push_back({"settings.tile_size", "--tile-size"});
  }
}

Result<void> apply_light(const std::string& text, v1::Scene& scene,
                         std::vector<Replaced>& replaced) {
  // The last "=" separates: an illuminant's name has none, a light's may.
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
    return problem("--light: \"" + text + "\" is not NAME=ILLUMINANT, such as ceiling=A");
  const std::string name = text.substr(0, equals);

  bool found = false;
  std::vector<std::string> names;
  for (int i = 0; i < scene.light_size(); ++i) {
    v1::Light* light = scene.mutable_light(i);
    names.push_back(light->name());
    if (name != "*" && name != light->name()) continue;
    found = true;
    light->mutable_spectrum()->Clear();
    light->mutable_spectrum()->set_standard(text.substr(equals + 1));
    replaced.push_back({"light[" + std::to_string(i) + "].spectrum", "--light"});
  }
  if (!found)
    return problem("--light: no light named \"" + name + "\"" + did_you_mean(name, names));
  return {};
}

/// True for the field itself and for everything inside it.
bool contains(const std::string& outer, const std::string& inner) {
  if (inner.compare(0, outer.size(), outer) != 0) return false;
  return inner.size() == outer.size() || inner[outer.size()] == '.' || inner[outer.size()] == '[';
}

}  // namespace

Result<std::vector<Replaced>> apply(const Overrides& overrides, v1::Scene& scene) {
  std::vector<Replaced> replaced;
  v1::Settings& settings = *scene.mutable_settings();

  Result<void> result = apply_method(overrides, settings, replaced);
  if (result) result = apply_goal(overrides, settings, replaced);
  if (result && overrides.size) result = apply_size(*overrides.size, settings, replaced);
  if (result && overrides.observer) result = apply_observer(*overrides.observer, settings);
  if (result && overrides.backend) result = apply_backend(*overrides.backend, settings, replaced);
  if (result && overrides.shading) result = apply_shading(*overrides.shading, settings, replaced);
  if (result) result = apply_development(overrides.development, settings, replaced);
  std::set<std::string> named;
  for (const std::string& light : overrides.lights) {
    const std::string name = light.substr(0, light.rfind('='));
    if (result && !named.insert(name).second)
      result = problem("--light: " + quoted(name) + " is named twice");
    if (result) result = apply_light(light, scene, replaced);
  }
  if (!result) return tl::unexpected<Problem>(std::move(result.error()));

  apply_numbers(overrides, settings, replaced);
  return replaced;
}

bool choose_a_method(const Overrides& overrides) {
  return overrides.method || overrides.samples || overrides.wavelengths || overrides.fitted ||
         overrides.multi_pass || overrides.bases || overrides.tolerance || overrides.deadline;
}

std::string option_of(const std::vector<Replaced>& replaced, const std::string& field) {
  for (const Replaced& one : replaced)
    if (contains(one.field, field)) return one.option;
  return {};
}

}  // namespace metamer::cli
