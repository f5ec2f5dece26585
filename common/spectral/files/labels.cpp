#include "common/spectral/files/labels.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace metamer::spectrum_text {
namespace {

constexpr std::string_view blanks = " \t";
constexpr std::size_t npos = std::string_view::npos;

void trim(std::string_view& text) {
  text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
  const std::size_t last = text.find_last_not_of(blanks);
  text = text.substr(0, last == std::string_view::npos ? 0 : last + 1);
}

/// Takes a unit off the end of a label in lower case: "380nm", "380 [nm]", "0.38 (µm)".
std::optional<WavelengthUnit> take_unit(std::string_view& label) {
  std::string_view rest = label;
  const bool bracket = rest.ends_with(']') || rest.ends_with(')');
  if (bracket) rest.remove_suffix(1);
  struct Spelling {
    std::string_view text;
    WavelengthUnit unit;
  };
  static constexpr std::array<Spelling, 4> spellings = {{{"nm", WavelengthUnit::nm},
                                                         {"um", WavelengthUnit::um},
                                                         {"µm", WavelengthUnit::um},    // U+00B5
                                                         {"μm", WavelengthUnit::um}}};  // U+03BC
  for (const Spelling& spelling : spellings) {
    if (!rest.ends_with(spelling.text)) continue;
    rest.remove_suffix(spelling.text.size());
    if (bracket && !rest.ends_with('[') && !rest.ends_with('(')) return std::nullopt;
    if (bracket) rest.remove_suffix(1);
    trim(rest);
    label = rest;
    return spelling.unit;
  }
  return std::nullopt;
}

std::optional<double> plain_number(std::string text, char decimal) {
  if (decimal == ',') std::replace(text.begin(), text.end(), ',', '.');
  double value = 0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, value, std::chars_format::fixed);
  if (error != std::errc() || end != last || !std::isfinite(value) || value < 0)
    return std::nullopt;
  return value;
}

bool has_any(std::string_view heading, std::initializer_list<std::string_view> words) {
  const std::string text = lower(heading);
  return std::any_of(words.begin(), words.end(),
                     [&](std::string_view word) { return text.find(word) != std::string::npos; });
}

/// "r[400 nm]" as "r400 nm": brackets around a number that ends the label.
std::string without_brackets(std::string text) {
  const std::size_t open = text.find_last_of("[(");
  const bool closed = text.ends_with(']') || text.ends_with(')');
  if (!closed || open == std::string::npos || open + 1 >= text.size()) return text;
  const char first = text[text.find_first_not_of(blanks, open + 1)];
  if (first < '0' || first > '9') return text;
  text.pop_back();
  return text.erase(open, 1);
}

}  // namespace

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

std::optional<Labelled> labelled_wavelength(std::string_view label, char decimal) {
  const std::string text = without_brackets(lower(label));
  std::string_view rest = text;
  trim(rest);
  std::optional<WavelengthUnit> unit = take_unit(rest);

  // What stands before the number: with a unit behind it anything, else one of the known words.
  const std::size_t digit = std::min(rest.find_first_of(".0123456789"), rest.size());
  std::string_view before = rest.substr(0, digit);
  trim(before);
  static constexpr std::array<std::string_view, 10> known = {
      "spec_", "spec", "spectral_nm", "spectral_nm_", "nm", "nm_", "r_", "t_", "wl", "wl_"};
  const bool is_known = std::find(known.begin(), known.end(), before) != known.end();
  // R400 is a reflectance; R1 to R15 are the indices of colour rendering.
  const bool is_letter = before == "r" || before == "t" || before == "rho" || before == "λ";
  if (!unit && !is_known && !is_letter) return std::nullopt;
  if (!unit && before.find("nm") != std::string_view::npos) unit = WavelengthUnit::nm;
  const auto value = plain_number(std::string(rest.substr(digit)), decimal);
  if (!value || (!unit && is_letter && *value < 100)) return std::nullopt;
  return Labelled{*value, unit};
}

std::optional<WavelengthUnit> unit_in(std::string_view heading) {
  if (has_any(heading, {"µm", "μm", "(um)", "[um]", "/um", "/ um", "micron", "micromet", "_um"}) ||
      lower(heading) == "um")
    return WavelengthUnit::um;
  if (has_any(heading, {"nm", "nanomet"})) return WavelengthUnit::nm;
  return std::nullopt;
}

bool says_percent(std::string_view heading) {
  if (has_any(heading, {"percent", "prozent", "pct"})) return true;
  // A number before the sign is of a name: "cotton 100%".
  for (std::size_t at = heading.find('%'); at != std::string_view::npos;
       at = heading.find('%', at + 1)) {
    const std::size_t before = heading.substr(0, at).find_last_not_of(blanks);
    if (before == std::string_view::npos || heading[before] < '0' || heading[before] > '9')
      return true;
  }
  return false;
}

std::string_view name_in(std::string_view heading) {
  for (const std::string_view unit : {"[%]", "(%)"}) {
    if (!heading.ends_with(unit)) continue;
    std::string_view name = heading.substr(0, heading.size() - unit.size());
    trim(name);
    if (!name.empty()) return name;
  }
  return heading;
}

std::string unusable_axis(std::string_view heading) {
  if (has_any(heading, {"thz", "frequenc", "frequenz"})) return "frequencies";
  if (has_any(heading, {"cm-1", "cm^-1", "cm⁻¹", "wavenumber", "wellenzahl", "raman"}))
    return "wavenumbers";
  if (has_any(heading, {"(ev)", "[ev]", "photon energy"})) return "energies";
  if (has_any(heading, {"å", "Å", "angstrom"})) return "ångströms";
  if (has_any(heading, {"(m)", "[m]", "/ m)"})) return "metres";
  return {};
}

std::string unusable_quantity(std::string_view heading) {
  const std::string text = lower(heading);
  const bool constant = has_any(heading, {"coefficient", "koeffizient"});  // k of a metal
  if (has_any(heading, {"absorb", "absorp", "extinktion", "extinction"}) && !constant)
    return "absorbance";
  if (text == "abs" || text.starts_with("abs.") || text.starts_with("abs ") ||
      text.starts_with("abs("))
    return "absorbance";
  if (text == "od" || text == "density" || has_any(heading, {"optical density"})) return "density";
  if (has_any(heading, {"k/s"})) return "K/S";
  if (has_any(heading, {"log10", "log(", "log r", "log t", "log 1"})) return "a logarithm";
  if (has_any(heading, {"photon", "quanta", "µmol", "μmol", "umol"})) return "a number of photons";
  return {};
}

bool says_wavelength(std::string_view heading) {
  if (has_any(heading, {"wavelength", "wellenl"})) return true;
  // R(λ) is what is measured at it.
  std::string_view rest = heading;
  trim(rest);
  const std::string text = lower(rest);
  return text.starts_with("lambda") || text.starts_with("λ") || text == "nm" || text == "um" ||
         text == "µm" || text == "μm" || text == "wl";
}

std::optional<Quantity> quantity_in(std::string_view text) {
  std::optional<Quantity> found;
  int count = 0;
  const auto look = [&](Quantity quantity, std::initializer_list<std::string_view> words) {
    if (!has_any(text, words)) return;
    found = quantity;
    ++count;
  };
  look(Quantity::reflectance, {"reflect", "remission"});
  look(Quantity::transmittance, {"transmi"});
  look(Quantity::emission,
       {"radiance", "emission ", "emissive", "spd", "w/m", "w/(m", "w/nm", "w/cm", "w/(cm", "w·m",
        "w m-2", "radiant", "spectral power", "strahldichte", "strahlungs", "bestrahlung"});
  return count == 1 ? found : std::nullopt;
}

std::optional<Quantity> quantity_of_heading(std::string_view heading) {
  if (const auto said = quantity_in(heading)) return said;
  std::string text = lower(heading);
  std::erase_if(text, [](char c) { return std::string_view(" \t%()[]/").find(c) != npos; });
  if (says_percent(heading) && text == "t") return Quantity::transmittance;
  if (says_percent(heading) && text == "r") return Quantity::reflectance;
  if (has_any(heading, {"counts", "intensity", "intensität", "power", "(a.u.)", "[a.u.]"}))
    return Quantity::emission;
  return std::nullopt;
}

}  // namespace metamer::spectrum_text
