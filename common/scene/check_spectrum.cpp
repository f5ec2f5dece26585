#include "common/scene/check_spectrum.h"

#include <algorithm>

#include "common/scene/check_wavelengths.h"
#include "common/spectral/cie.h"

namespace metamer {

namespace {

void check_samples(const v1::Samples& samples, const std::string& field, SpectrumRole role,
                   Findings& findings) {
  const int count = samples.wavelength_size();
  if (count == 0) return findings.add(field, "samples need at least one wavelength");
  if (samples.value_size() != count) {
    return findings.add(field + ".value", "samples need as many values as wavelengths (" +
                                              std::to_string(samples.value_size()) + " values, " +
                                              std::to_string(count) + " wavelengths)");
  }
  const std::vector<double> nm(samples.wavelength().begin(), samples.wavelength().end());
  if (!check_wavelengths(nm, field + ".wavelength", findings)) return;

  const std::size_t before = findings.size();
  for (int i = 0; i < count; ++i) {
    const std::string wrong = value_fault(samples.value(i), role);
    if (wrong.empty()) continue;
    findings.add(indexed(field + ".value", static_cast<std::size_t>(i)),
                 wrong + " (it is " + number_text(samples.value(i)) + " at " +
                     number_text(samples.wavelength(i)) + " nm)");
  }
  if (findings.size() == before && role == SpectrumRole::emission &&
      is_dark({samples.value().begin(), samples.value().end()})) {
    findings.add(field + ".value", "an emission must not be 0 at every wavelength");
  }
}

}  // namespace

std::string value_fault(double value, SpectrumRole role) {
  // Written so that a NaN is a fault, too.
  const auto within = [value](double low, double high) { return value >= low && value <= high; };
  switch (role) {
    case SpectrumRole::emission:
      return value >= 0 ? "" : "an emission must not be negative";
    case SpectrumRole::property:
      return within(0, 1) ? "" : "a property must lie in 0..1";
    case SpectrumRole::reflectance:
      return within(0, 0.999999) ? "" : "a reflectance that gives n must lie in 0..0.999999";
    case SpectrumRole::index:
      return within(0.01, 100) ? "" : "an index of refraction must lie in 0.01..100";
    case SpectrumRole::extinction:
      return within(0, 100) ? "" : "an extinction coefficient must lie in 0..100";
  }
  return {};
}

bool is_dark(const std::vector<double>& values) {
  return std::none_of(values.begin(), values.end(), [](double value) { return value > 0; });
}

void check_spectrum(const v1::Spectrum& spectrum, const std::string& field, SpectrumRole role,
                    Findings& findings) {
  switch (spectrum.source_case()) {
    case v1::Spectrum::kStandard:
      if (role != SpectrumRole::emission) {
        findings.add(field + ".standard", "a standard illuminant is an emission, not a property");
      } else if (cie::illuminant(spectrum.standard()) == nullptr) {
        findings.add(field + ".standard",
                     quoted(spectrum.standard()) + " is not a standard illuminant" +
                         did_you_mean(spectrum.standard(), cie::illuminant_names()));
      }
      break;
    case v1::Spectrum::kFile:
      if (spectrum.file().empty()) findings.add(field + ".file", "file must not be empty");
      break;
    case v1::Spectrum::kConstant: {
      const std::string wrong = value_fault(spectrum.constant(), role);
      if (!wrong.empty()) {
        findings.add(field + ".constant",
                     wrong + " (it is " + number_text(spectrum.constant()) + ")");
      } else if (role == SpectrumRole::emission && spectrum.constant() == 0) {
        findings.add(field + ".constant", "an emission must not be 0 at every wavelength");
      }
      break;
    }
    case v1::Spectrum::kSamples:
      check_samples(spectrum.samples(), field + ".samples", role, findings);
      break;
    case v1::Spectrum::SOURCE_NOT_SET:
      findings.add(field, "spectrum needs a standard, a file, a constant or samples");
      break;
  }
  if (!spectrum.entry().empty() && spectrum.source_case() != v1::Spectrum::kFile) {
    findings.add(field + ".entry", "entry is for spectra from a file");
  }
}

}  // namespace metamer
