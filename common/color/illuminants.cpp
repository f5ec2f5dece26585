#include "common/color/illuminants.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <vector>

#include "common/color/radiators.h"
#include "common/spectral/cie.h"
#include "common/spectral/lines.h"
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
  }
  return with_lines({}, lines);
}

/// How a name would have to be written that is nearly that of a temperature or a line: "2856",
/// "D6504K", "D:6504 K", "546 nm". Empty: it is like none.
std::string meant(std::string_view name) {
  std::string text;
  for (const char c : name)
    if (c != ' ') text += c;
  const bool line = text.ends_with("nm");
  const bool daylight = text.starts_with('D') || text.starts_with('d');
  if (daylight) text.erase(0, text.size() > 1 && text[1] == ':' ? 2 : 1);
  if (line) text.erase(text.size() - 2);
  if (text.ends_with('K') || text.ends_with('k')) text.pop_back();
  const auto number = number_of(text);
  if (!number) return {};
  if (line) return daylight ? std::string() : "a line is " + quoted(text + "nm");
  if (!(*number >= coldest_kelvin)) return {};
  return daylight ? "daylight of that temperature is " + quoted("D:" + text + "K")
                  : "a black body of that temperature is " + quoted(text + "K");
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
  return kelvin_of(name) || (name.starts_with("D:") && kelvin_of(name.substr(2))) ||
         lines_of(name) || !meant(name).empty();
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
  if (const auto lines = lines_of(name)) return light_of_lines(name, *lines);
  if (const std::string hint = meant(name); !hint.empty())
    return problem(quoted(name) + " is not a standard illuminant; " + hint);
  return problem(quoted(name) + " is not a standard illuminant" +
                 did_you_mean(name, cie::illuminant_names()));
}

}  // namespace metamer
