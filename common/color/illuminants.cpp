#include "common/color/illuminants.h"

#include <charconv>
#include <optional>

#include "common/color/radiators.h"
#include "common/spectral/cie.h"
#include "common/spectral/wavelengths.h"

namespace metamer {
namespace {

/// The number of "6504K". Nothing: that is no temperature.
std::optional<double> kelvin_of(std::string_view text) {
  if (!text.ends_with('K')) return std::nullopt;
  text.remove_suffix(1);
  double kelvin = 0;
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, kelvin, std::chars_format::fixed);
  if (error != std::errc() || end != last) return std::nullopt;
  return kelvin;
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

bool names_temperature(std::string_view name) {
  return kelvin_of(name) || (name.starts_with("D:") && kelvin_of(name.substr(2)));
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
  return problem(quoted(name) + " is not a standard illuminant" +
                 did_you_mean(name, cie::illuminant_names()));
}

}  // namespace metamer
