#include "common/spectral/files/interpret.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/spectral/wavelengths.h"

namespace metamer {
namespace {

bool is_property(Quantity quantity) { return quantity != Quantity::emission; }

/// What a spectrum is, where nobody said it.
Quantity guessed(const SpectrumFile& file, const Spectrum& spectrum,
                 std::vector<std::string>& notes) {
  const auto [low, high] = std::minmax_element(spectrum.values.begin(), spectrum.values.end());
  if (file.scale == Scale::percent) {
    notes.push_back("taken for a reflectance, as it is in percents");
    return Quantity::reflectance;
  }
  if (*low >= 0 && *high <= 1) {
    notes.push_back("taken for a reflectance, as its values lie in 0..1");
    return Quantity::reflectance;
  }
  notes.push_back("taken for an emission, as its values go from " + number_text(*low) + " to " +
                  number_text(*high));
  return Quantity::emission;
}

/// That what nobody said to be a lamp looks like a reflectance: it is in percents, or stays within
/// 0..1 and below the 1 that a normalised lamp reaches.
void note_likely_property(const SpectrumFile& file, const Spectrum& spectrum,
                          std::vector<std::string>& notes) {
  constexpr double nearly_one = 0.999;
  const auto [low, high] = std::minmax_element(spectrum.values.begin(), spectrum.values.end());
  if (file.scale == Scale::percent)
    notes.push_back("taken for an emission, though the file is in percents");
  else if (!file.scale && spectrum.values.size() > 1 && *low > 0 && *high < nearly_one)
    notes.push_back("taken for an emission, though its values lie in 0..1, as a reflectance's");
}

Scale scale_of(const SpectrumFile& file, const Spectrum& spectrum, const Reading& reading,
               std::vector<std::string>& notes) {
  if (reading.scale) return *reading.scale;
  if (file.scale) return *file.scale;
  // One spectrum of a file is written as the others.
  const double own = *std::max_element(spectrum.values.begin(), spectrum.values.end());
  const double most = std::max(file.largest, own);
  if (most <= surely_percent) return Scale::one;
  notes.push_back("taken for percents, as the file's values reach " + number_text(most));
  return Scale::percent;
}

/// Brings values into the quantity's range, and says how many were not.
void clamp_values(Spectrum& spectrum, Quantity quantity, std::vector<std::string>& notes) {
  const double high = is_property(quantity) ? 1 : std::numeric_limits<double>::max();
  std::size_t changed = 0;
  for (double& value : spectrum.values) {
    const double within = std::clamp(value, 0.0, high);
    changed += within != value ? 1 : 0;
    value = within;
  }
  if (changed == 0) return;
  notes.push_back(std::to_string(changed) + " of " + std::to_string(spectrum.values.size()) +
                  (is_property(quantity) ? " values were outside 0..1 and are clamped"
                                         : " values were below 0 and are clamped"));
}

/// What keeps values from being that quantity. Nothing: they may.
std::optional<std::string> range_fault(const Spectrum& spectrum, Quantity quantity) {
  for (std::size_t i = 0; i < spectrum.values.size(); ++i) {
    const double value = spectrum.values[i];
    const std::string at = number_text(value) + " at " + number_text(spectrum.nm[i]) + " nm";
    if (value < 0 && !is_property(quantity))
      return "an emission must not be negative (it is " + at + "); clamp makes noise below 0 to 0";
    if (value < 0) return "a " + quantity_text(quantity) + " must lie in 0..1 (it is " + at + ")";
    if (value > 1 && is_property(quantity))
      return "a " + quantity_text(quantity) + " must lie in 0..1 (it is " + at +
             "): above 1 is fluorescence, which clamp leaves out and Material.fluorescence models, "
             "or "
             "another scale";
  }
  return std::nullopt;
}

/// That no eye sees any of its wavelengths.
std::optional<std::string> out_of_sight(const Spectrum& spectrum) {
  const double from = spectrum.nm.front(), to = spectrum.nm.back();
  if (to > observer_from_nm && from < observer_to_nm) return std::nullopt;
  return "its wavelengths, " + number_text(from) + " to " + number_text(to) +
         " nm, are none that an eye sees";
}

}  // namespace

std::string quantity_text(Quantity quantity) {
  switch (quantity) {
    case Quantity::reflectance:
      return "reflectance";
    case Quantity::transmittance:
      return "transmittance";
    case Quantity::emission:
      return "emission";
  }
  return {};
}

Result<Interpreted> interpret(const SpectrumFile& file, NamedSpectrum one, const Reading& reading,
                              Use use) {
  Interpreted result{.spectrum = std::move(one.spectrum), .quantity = Quantity::reflectance};
  result.notes = file.notes;
  if (one.blank > 0)
    result.notes.push_back(std::to_string(one.blank) +
                           (one.blank == 1 ? " cell is" : " cells are") +
                           " blank: there are no samples at these wavelengths");
  // What it is.
  const std::optional<Quantity> said = reading.as ? reading.as : file.quantity;
  if (said && use != Use::any && is_property(*said) != (use == Use::property))
    return problem("it is a" + std::string(*said == Quantity::emission ? "n " : " ") +
                   quantity_text(*said) + (reading.as ? "" : " by its own words") + ", and a" +
                   (use == Use::emission ? "n emission" : " reflectance or transmittance") +
                   " is needed");
  if (said)
    result.quantity = *said;
  else if (use == Use::any)
    result.quantity = guessed(file, result.spectrum, result.notes);
  else
    result.quantity = use == Use::emission ? Quantity::emission : Quantity::reflectance;
  if (!said && use == Use::emission) note_likely_property(file, result.spectrum, result.notes);

  // How it is written.
  if (is_property(result.quantity) &&
      scale_of(file, result.spectrum, reading, result.notes) == Scale::percent)
    for (double& value : result.spectrum.values) value /= 100;
  if (reading.clamp) clamp_values(result.spectrum, result.quantity, result.notes);
  if (auto fault = range_fault(result.spectrum, result.quantity)) {
    if (use != Use::any) return problem(std::move(*fault));
    result.notes.push_back(std::move(*fault));
  }
  if (auto unseen = out_of_sight(result.spectrum)) {
    if (use != Use::any) return problem(*unseen + "; are they in another unit?");
    result.notes.push_back(std::move(*unseen));
  }
  return result;
}

}  // namespace metamer
