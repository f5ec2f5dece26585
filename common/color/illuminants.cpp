#include "common/color/illuminants.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "common/color/radiators.h"
#include "common/color/sunlight.h"
#include "common/spectral/cie.h"
#include "common/spectral/lines.h"
#include "common/spectral/value_bounds.h"
#include "common/spectral/wavelengths.h"

namespace metamer {
namespace {

std::optional<double> number_of(std::string_view text) {
  double number = 0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, number, std::chars_format::fixed);
  return error == std::errc() && end == last ? std::optional(number) : std::nullopt;
}

/// The number of "6504K" or "546.1nm" before its unit. Nothing: it is none.
std::optional<double> number_before(std::string_view text, std::string_view unit) {
  return text.ends_with(unit) ? number_of(text.substr(0, text.size() - unit.size())) : std::nullopt;
}

struct Sun {
  double turbidity, elevation;
};

/// "sun:3:45". Nothing: it is none.
std::optional<Sun> sun_of(std::string_view name) {
  if (!name.starts_with("sun:")) return std::nullopt;
  name.remove_prefix(4);
  const std::size_t at = std::min(name.find(':'), name.size());
  const auto turbidity = number_of(name.substr(0, at));
  const auto elevation = number_of(name.substr(std::min(at + 1, name.size())));
  return turbidity && elevation ? std::optional(Sun{*turbidity, *elevation}) : std::nullopt;
}

std::optional<double> kelvin_of(std::string_view text) { return number_before(text, "K"); }

/// "436nm:0.6+546.1nm" cut at its signs. Nothing: it is no list of lines.
std::optional<std::vector<Line>> lines_of(std::string_view name) {
  std::vector<Line> lines;
  for (std::size_t begin = 0; begin <= name.size();) {
    const std::size_t end = std::min(name.find('+', begin), name.size());
    const std::string_view one = name.substr(begin, end - begin);
    const std::size_t colon = std::min(one.find(':'), one.size());
    const auto nm = number_before(one.substr(0, colon), "nm");
    const auto power = colon == one.size() ? 1 : number_of(one.substr(colon + 1));
    if (!nm || !power) return std::nullopt;
    lines.push_back({*nm, *power});
    begin = end + 1;
  }
  return lines;
}

Result<Spectrum> light_of_lines(std::string_view name, const std::vector<Line>& lines) {
  if (lines.size() > most_lines)
    return problem("at most " + std::to_string(most_lines) + " lines are possible");
  for (const Line& line : lines) {
    if (!(line.nm > observer_from_nm && line.nm < observer_to_nm))
      return problem(quoted(name) + " is out of range: a line lies between " +
                     number_text(observer_from_nm) + " and " + number_text(observer_to_nm) +
                     " nm (it is " + number_text(line.nm) + ")");
    if (!(line.power > 0) || !std::isfinite(line.power))
      return problem(quoted(name) + ": a line's power is above 0");
    if (!(line.power >= least_peak && line.power <= most_value))
      return problem(quoted(name) + ": a line's power lies in " + number_text(least_peak) + ".." +
                     number_text(most_value));
  }
  return with_lines({}, lines);
}

struct Meant {
  const char* what;
  std::string name;
};

/// How lines would have to be written whose names lack a unit: "436:0.6 + 546.1".
std::optional<Meant> meant_lines(std::string text) {
  std::string name;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find('+', begin), text.size());
    const std::string one = text.substr(begin, end - begin);
    const std::string power = one.substr(std::min(one.find(':'), one.size()));
    std::string nm = one.substr(0, one.size() - power.size());
    if (nm.ends_with("nm")) nm.resize(nm.size() - 2);
    if (!number_of(nm) || (!power.empty() && !number_of(power.substr(1)))) return std::nullopt;
    name += (name.empty() ? "" : "+") + nm + "nm" + power;
    begin = end + 1;
  }
  return Meant{"a list of lines", std::move(name)};
}

/// How a name would have to be written that is nearly that of a temperature or of lines: "2856",
/// "D6504K", "D:6504 K", "546 nm", "436:0.6 + 546"; and what that is. Nothing: it is like none.
std::optional<Meant> meant(std::string_view name) {
  std::string text;
  for (const char c : name)
    if (c != ' ') text += c;
  const bool daylight = text.starts_with('D') || text.starts_with('d');
  if (!daylight && text.find_first_of("+:") != std::string::npos)
    return meant_lines(std::move(text));
  const bool line = text.ends_with("nm");
  if (daylight) text.erase(0, text.size() > 1 && text[1] == ':' ? 2 : 1);
  if (line) text.erase(text.size() - 2);
  if (text.ends_with('K') || text.ends_with('k')) text.pop_back();
  const auto number = number_of(text);
  if (!number) return std::nullopt;
  if (line) return daylight ? std::nullopt : std::optional(Meant{"a line", text + "nm"});
  if (!(*number >= coldest_kelvin)) return std::nullopt;
  return daylight ? Meant{"daylight of that temperature", "D:" + text + "K"}
                  : Meant{"a black body of that temperature", text + "K"};
}

tl::unexpected<Problem> out_of_range(std::string_view name, const char* what, double from,
                                     double to) {
  return problem(quoted(name) + " is out of range: " + what + " may have " + number_text(from) +
                 " to " + number_text(to) + " K");
}

std::vector<double> positions(double step) {
  return Wavelengths::uniform(300, observer_to_nm, step)->nm();
}

}  // namespace

bool names_formula(std::string_view name) {
  return kelvin_of(name) || (name.starts_with("D:") && kelvin_of(name.substr(2))) || sun_of(name) ||
         lines_of(name) || meant(name);
}

Result<Spectrum> illuminant_named(std::string_view name) {
  if (const Spectrum* table = cie::illuminant(name)) return *table;
  if (name.starts_with("D:"))
    if (const auto kelvin = kelvin_of(name.substr(2))) {
      if (!(*kelvin >= 4000 && *kelvin <= 25000))
        return out_of_range(name, "daylight", 4000, 25000);
      // The CIE's components are tables by 5 nm with straight lines between.
      return daylight(*kelvin, positions(5));
    }
  if (const auto kelvin = kelvin_of(name)) {
    if (!(*kelvin >= coldest_kelvin && *kelvin <= hottest_kelvin))
      return out_of_range(name, "a black body", coldest_kelvin, hottest_kelvin);
    return planckian(*kelvin, positions(1));
  }
  if (const auto sun = sun_of(name)) {
    if (!(sun->turbidity >= least_turbidity && sun->turbidity <= most_turbidity &&
          sun->elevation >= 0 && sun->elevation <= most_elevation))
      return problem(quoted(name) + " is out of range: sunlight has a turbidity of " +
                     number_text(least_turbidity) + " to " + number_text(most_turbidity) +
                     " and an elevation of 0 to " + number_text(most_elevation) + " degrees");
    return sunlight(sun->turbidity, sun->elevation);
  }
  if (const auto lines = lines_of(name)) return light_of_lines(name, *lines);
  const std::string wrong = quoted(name) + " is not a standard illuminant";
  if (const auto hint = meant(name))
    return tl::unexpected(
        Problem{.field = {},
                .file = {},
                .message = wrong + "; " + hint->what + " is " + quoted(hint->name),
                .was = std::string(name),
                .meant = hint->name});
  return tl::unexpected(unknown_name(wrong, name, cie::illuminant_names()));
}

}  // namespace metamer
