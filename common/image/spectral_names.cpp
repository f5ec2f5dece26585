#include "common/image/spectral_names.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "common/spectral/wavelengths.h"

namespace metamer {
namespace {

struct Prefix {
  std::string_view text;
  int power;
};

/// The SI's prefixes; µ is U+00B5 or the Greek letter. "da" comes before "a".
constexpr std::array prefixes = {
    Prefix{"Y", 24},  Prefix{"Z", 21},        Prefix{"E", 18},        Prefix{"P", 15},
    Prefix{"T", 12},  Prefix{"G", 9},         Prefix{"M", 6},         Prefix{"k", 3},
    Prefix{"h", 2},   Prefix{"da", 1},        Prefix{"d", -1},        Prefix{"c", -2},
    Prefix{"m", -3},  Prefix{"\xC2\xB5", -6}, Prefix{"\xCE\xBC", -6}, Prefix{"u", -6},
    Prefix{"n", -9},  Prefix{"p", -12},       Prefix{"f", -15},       Prefix{"a", -18},
    Prefix{"z", -21}, Prefix{"y", -24}};

constexpr double light_speed = 299792458;  ///< m/s

/// A number with a decimal comma or point; nothing where it is none. Overflow gives infinity.
std::optional<double> parse_decimal(std::string_view words) {
  std::string text(words);
  std::replace(text.begin(), text.end(), ',', '.');
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) return std::nullopt;
  return error == std::errc{} ? value : HUGE_VAL;
}

/// "550,000000nm" → 550.
Result<double> parse_wavelength(std::string_view text) {
  // Take the unit from the end, then the prefix.
  const std::string_view whole = text;
  const bool frequency = text.ends_with("Hz");
  if (!frequency && !text.ends_with('m'))
    return problem(quoted(whole) + " ends in no unit of length or frequency");
  text.remove_suffix(frequency ? 2 : 1);
  int power = 0;
  for (const Prefix& prefix : prefixes) {
    if (!text.ends_with(prefix.text)) continue;
    text.remove_suffix(prefix.text.size());
    power = prefix.power;
    break;
  }
  const std::optional<double> value = parse_decimal(text);
  if (!value) return problem(quoted(whole) + " is not a number and a unit");

  // A power of 0 leaves nanometres exactly as they are written.
  const double nm = frequency ? light_speed / (*value * std::pow(10.0, power)) * 1e9
                              : *value * std::pow(10.0, power + 9);
  if (!(nm > 0) || !std::isfinite(nm))
    return problem("the wavelength " + quoted(whole) + " must be finite and above 0");
  return nm;
}

std::optional<SpectralChannel::Kind> kind_of(std::string_view name) {
  if (name.starts_with("T.")) return SpectralChannel::Kind::reflectance;
  if (name.starts_with("S0.")) return SpectralChannel::Kind::emission;
  if (name.starts_with("S1.") || name.starts_with("S2.") || name.starts_with("S3."))
    return SpectralChannel::Kind::polarisation;
  return std::nullopt;
}

}  // namespace

Result<std::optional<SpectralChannel>> parse_spectral_channel(std::string_view name) {
  const auto kind = kind_of(name);
  if (!kind || !(name.ends_with('m') || name.ends_with("Hz"))) return std::nullopt;
  const Result<double> nm = parse_wavelength(name.substr(name.find('.') + 1));
  if (!nm) return problem("channel " + quoted(name) + ": " + nm.error().message);
  return SpectralChannel{.kind = *kind, .nm = *nm};
}

std::string spectral_channel_name(const SpectralChannel& channel) {
  std::array<char, 400> digits{};
  char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), channel.nm,
                                  std::chars_format::fixed, 6)
                        .ptr;
  std::replace(digits.data(), end, '.', ',');
  const char* stem = channel.kind == SpectralChannel::Kind::reflectance ? "T." : "S0.";
  return stem + std::string(digits.data(), end) + "nm";
}

std::string emissive_units(std::string_view text) {
  std::string plain;
  for (const char c : text)
    if (c != ' ') plain += c;
  for (const char* spelling : {"W.m^-2.sr^-1", "W/m^2/sr", "W/(m^2.sr)", "W/(m^2*sr)", "W/m2/sr"})
    if (plain == spelling) return radiance_units;
  return std::string(text);
}

}  // namespace metamer
