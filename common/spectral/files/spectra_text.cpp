#include "common/spectral/files/spectra_text.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <optional>

namespace metamer {
namespace {

/// Never with an exponent, which column names may not have.
std::string plain_number(double value) {
  std::array<char, 400> text{};
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::fixed).ptr;
  return {text.data(), end};
}

/// Argyll takes a value without a point for one of a column of integers, and refuses that.
std::string real_number(double value) {
  const std::string text = number_text(value);
  return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

std::string pairs(const Spectrum& spectrum) {
  std::string text;
  for (std::size_t i = 0; i < spectrum.nm.size(); ++i)
    text += number_text(spectrum.nm[i]) + " " + number_text(spectrum.values[i]) + "\n";
  return text;
}

/// The step, where from, to and step give exactly these positions again.
std::optional<double> uniform_step(const std::vector<double>& nm) {
  if (nm.size() == 1) return 1;
  // The distance as somebody may have written it is shorter than the one that subtraction leaves.
  const double raw = (nm.back() - nm.front()) / static_cast<double>(nm.size() - 1);
  for (const double step : {std::round(raw * 1e6) / 1e6, raw}) {
    const auto positions = Wavelengths::uniform(nm.front(), nm.back(), step);
    if (positions && positions->nm() == nm) return step;
  }
  return std::nullopt;
}

Result<std::string> uniform(const Spectrum& spectrum) {
  const auto step = uniform_step(spectrum.nm);
  if (!step) return problem("its steps are not equal: resample it, or write pairs or CGATS");
  std::string text = number_text(spectrum.nm.front()) + " " + number_text(spectrum.nm.back()) +
                     " " + number_text(*step) + "\n";
  for (const double value : spectrum.values) text += number_text(value) + "\n";
  return text;
}

std::string quoted_name(const std::string& name) {
  std::string result = "\"";
  for (const char c : name)
    result += c == '"' ? '\'' : static_cast<unsigned char>(c) < 32 || c == 127 ? '?' : c;
  return result + "\"";
}

/// Whether first, last and count stand for exactly these positions, spaced as cgats.cpp does.
bool header_gives(const std::vector<double>& nm) {
  if (nm.size() < 2) return false;
  const double range = nm.back() - nm.front(), steps = static_cast<double>(nm.size() - 1);
  for (std::size_t i = 0; i + 1 < nm.size(); ++i)
    if (nm.front() + range * static_cast<double>(i) / steps != nm[i]) return false;
  return true;
}

/// As Argyll's programs spell it.
std::string measurement_type(Quantity quantity) {
  switch (quantity) {
    case Quantity::reflectance:
      return "REFLECTIVE";
    case Quantity::transmittance:
      return "TRANSMISSIVE";
    case Quantity::emission:
      return "EMISSION";
  }
  return {};
}

Result<std::string> cgats(const std::vector<NamedSpectrum>& spectra,
                          std::optional<Quantity> quantity) {
  const std::vector<double>& nm = spectra.front().spectrum.nm;
  for (const NamedSpectrum& one : spectra)
    if (one.spectrum.nm != nm)
      return problem("spectra of one file need the same wavelengths: resample them first");

  // A header where it gives these very positions, as Argyll wants one; else the columns' names.
  const bool header = header_gives(nm);
  std::string text = "SPECT\n\nDESCRIPTOR \"Spectra\"\nORIGINATOR \"metamer\"\n";
  if (quantity) text += "MEAS_TYPE \"" + measurement_type(*quantity) + "\"\n";
  if (header)
    text += "SPECTRAL_BANDS " + std::to_string(nm.size()) + "\nSPECTRAL_START_NM " +
            plain_number(nm.front()) + "\nSPECTRAL_END_NM " + plain_number(nm.back()) + "\n";
  text += "SPECTRAL_NORM 1\n\nNUMBER_OF_FIELDS " + std::to_string(nm.size() + 2) +
          "\nBEGIN_DATA_FORMAT\nSAMPLE_ID SAMPLE_NAME";
  for (const double at : nm)
    text += " SPEC_" + (header ? std::to_string(std::lround(at)) : plain_number(at));
  text +=
      "\nEND_DATA_FORMAT\n\nNUMBER_OF_SETS " + std::to_string(spectra.size()) + "\nBEGIN_DATA\n";
  std::size_t id = 0;
  for (const NamedSpectrum& one : spectra) {
    text += std::to_string(++id) + " " + quoted_name(one.name);
    for (const double value : one.spectrum.values) text += " " + real_number(value);
    text += "\n";
  }
  return text + "END_DATA\n";
}

}  // namespace

Result<std::string> spectra_text(const std::vector<NamedSpectrum>& spectra, SpectrumFormat format,
                                 std::optional<Quantity> quantity) {
  assert(!spectra.empty());
  if (format == SpectrumFormat::cgats) return cgats(spectra, quantity);
  if (spectra.size() > 1)
    return problem("a plain file holds one spectrum, not " + std::to_string(spectra.size()) +
                   ": write CGATS, or choose one");
  const Spectrum& only = spectra.front().spectrum;
  return format == SpectrumFormat::pairs ? pairs(only) : uniform(only);
}

EnergyCheck check_energy(const Spectrum& original, const Spectrum& resampled, Outside outside) {
  // Between the samples of both, both are straight lines.
  std::vector<double> nm = original.nm;
  nm.insert(nm.end(), resampled.nm.begin(), resampled.nm.end());
  std::sort(nm.begin(), nm.end());
  nm.erase(std::unique(nm.begin(), nm.end()), nm.end());
  const std::vector<double> before = resample(original, nm, outside).values;
  const std::vector<double> after = resample(resampled, nm, Outside::zero).values;

  EnergyCheck result;
  double difference = 0;
  std::size_t next = 1;  // The new sample that ends the stretch at hand.
  for (std::size_t i = 1; i < nm.size(); ++i) {
    const double width = nm[i] - nm[i - 1];
    const bool has_data = nm[i - 1] >= original.nm.front() && nm[i] <= original.nm.back();
    const double own =
        has_data || outside == Outside::hold ? (before[i - 1] + before[i]) / 2 * width : 0;
    if (nm[i] <= resampled.nm.front() || nm[i - 1] >= resampled.nm.back()) {
      result.outside += own;
      continue;
    }
    const double made = (after[i - 1] + after[i]) / 2 * width;
    result.before += own;
    result.after += made;
    difference += made - own;
    if (nm[i] < resampled.nm[next]) continue;
    if (std::abs(difference) > std::abs(result.worst)) {
      result.worst = difference;
      result.worst_from = resampled.nm[next - 1];
      result.worst_to = resampled.nm[next];
    }
    difference = 0;
    ++next;
  }
  return result;
}

}  // namespace metamer
