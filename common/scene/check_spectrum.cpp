#include "common/scene/check_spectrum.h"

#include <algorithm>

#include "common/color/illuminants.h"
#include "common/scene/check_day.h"
#include "common/scene/check_wavelengths.h"
#include "common/scene/interpolated.h"
#include "common/scene/limits.h"
#include "common/spectral/value_bounds.h"

namespace metamer {

namespace {

double nearest_allowed(double value, SpectrumRole role) {
  const ValueRange range = value_range(role);
  return std::clamp(value, range.low, range.high);
}

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
                     number_text(samples.wavelength(i)) + " nm)",
                 samples.value(i), nearest_allowed(samples.value(i), role));
  }
  if (findings.size() == before && role == SpectrumRole::emission &&
      is_dark({samples.value().begin(), samples.value().end()})) {
    findings.add(field + ".value", "an emission must not be 0 at every wavelength");
  }
  if (findings.size() > before) return;
  if (const auto sound = make_spectrum(nm, {samples.value().begin(), samples.value().end()});
      !sound)
    findings.add(field + ".value", sound.error().message);
}

void check_lines(const v1::Spectrum& spectrum, const std::string& field, SpectrumRole role,
                 Findings& findings) {
  if (spectrum.line().empty()) return;
  if (role != SpectrumRole::emission) return findings.add(field, "lines are for emissions");
  if (spectrum.line_size() > limits::max_lines) {
    return findings.add(field, "at most " + std::to_string(limits::max_lines) +
                                   " lines are possible (there are " +
                                   std::to_string(spectrum.line_size()) + ")");
  }
  for (int i = 0; i < spectrum.line_size(); ++i) {
    const v1::Line& line = spectrum.line(i);
    const std::string place = indexed(field, static_cast<std::size_t>(i));
    check_range(line.nm(), limits::min_wavelength, limits::max_wavelength, place + ".nm", findings);
    if (!(line.power() > 0)) {
      findings.add(place + ".power",
                   "power must be above 0 (it is " + number_text(line.power()) + ")");
    } else {
      check_range(line.power(), least_peak, most_value, place + ".power", findings);
    }
  }
}

/// Samples are asked here whether they can be interpolated so; files when they are read.
void check_interpolation(const v1::Spectrum& spectrum, const std::string& field,
                         Findings& findings) {
  const auto asked = interpolation_of(spectrum);
  if (!asked) return;
  if (!spectrum.has_file() && !spectrum.has_samples())
    return findings.add(field, "interpolation is for spectra from a file or from samples");
  if (spectrum.has_file()) return;
  if (const auto fault = interpolation_fault(to_spectrum(spectrum.samples()), *asked))
    findings.add(field, *fault);
}

}  // namespace

std::string value_fault(double value, SpectrumRole role) {
  // Written so that a NaN is a fault, too.
  const ValueRange range = value_range(role);
  if (value >= range.low && value <= range.high) return {};
  switch (role) {
    case SpectrumRole::emission:
      return "an emission must not be negative";
    case SpectrumRole::property:
      return "a property must lie in 0..1";
    case SpectrumRole::reflectance:
      return "a reflectance that gives n must lie in 0..0.999999";
    case SpectrumRole::index:
      return "an index of refraction must lie in 0.01..100";
    case SpectrumRole::extinction:
      return "an extinction coefficient must lie in 0..100";
    case SpectrumRole::excitation:
      return "an excitation must lie in 0..1";
  }
  return {};
}

bool is_dark(const std::vector<double>& values) {
  return std::none_of(values.begin(), values.end(), [](double value) { return value > 0; });
}

std::optional<Interpolation> interpolation_of(const v1::Spectrum& spectrum) {
  switch (spectrum.interpolation()) {
    case v1::Spectrum::LINEAR:
      return Interpolation::linear;
    case v1::Spectrum::SPRAGUE:
      return Interpolation::sprague;
    case v1::Spectrum::MONOTONE_CUBIC:
      return Interpolation::monotone_cubic;
    case v1::Spectrum::RECOMMENDED:
    case v1::Spectrum_Interpolation_Spectrum_Interpolation_INT_MIN_SENTINEL_DO_NOT_USE_:
    case v1::Spectrum_Interpolation_Spectrum_Interpolation_INT_MAX_SENTINEL_DO_NOT_USE_:
      break;
  }
  return std::nullopt;
}

Spectrum to_spectrum(const v1::Samples& samples) {
  return {{samples.wavelength().begin(), samples.wavelength().end()},
          {samples.value().begin(), samples.value().end()}};
}

void check_spectrum(const v1::Spectrum& spectrum, const std::string& field, SpectrumRole role,
                    Findings& findings) {
  const std::size_t before = findings.size();
  switch (spectrum.source_case()) {
    case v1::Spectrum::kStandard:
      if (role != SpectrumRole::emission) {
        findings.add(field + ".standard", "a standard illuminant is an emission, not a property");
      } else if (const auto light = illuminant_named(spectrum.standard()); !light) {
        findings.add(field + ".standard", light.error());
      }
      break;
    case v1::Spectrum::kFile:
      if (spectrum.file().empty()) findings.add(field + ".file", "file must not be empty");
      break;
    case v1::Spectrum::kConstant: {
      const std::string wrong = value_fault(spectrum.constant(), role);
      if (!wrong.empty()) {
        const std::string message = wrong + " (it is " + number_text(spectrum.constant()) + ")";
        if (role == SpectrumRole::emission) {  // 0, the nearest, would be wrong, too
          findings.add(field + ".constant", message);
        } else {
          findings.add(field + ".constant", message, spectrum.constant(),
                       nearest_allowed(spectrum.constant(), role));
        }
      } else if (role == SpectrumRole::emission && spectrum.constant() == 0) {
        findings.add(field + ".constant", "an emission must not be 0 at every wavelength");
      } else if (role == SpectrumRole::emission) {
        check_range(spectrum.constant(), least_peak, most_value, field + ".constant", findings);
      }
      break;
    }
    case v1::Spectrum::kSamples:
      check_samples(spectrum.samples(), field + ".samples", role, findings);
      break;
    case v1::Spectrum::kSunlight:
      if (role != SpectrumRole::emission)
        findings.add(field + ".sunlight", "sunlight is an emission, not a property");
      else
        check_day(spectrum.sunlight(), field + ".sunlight", findings);
      break;
    case v1::Spectrum::SOURCE_NOT_SET:
      if (role != SpectrumRole::emission) {
        findings.add(field, "spectrum needs a standard, a file, a constant or samples");
      } else if (spectrum.line().empty()) {
        findings.add(field,
                     "spectrum needs a standard, a file, a constant, samples, sunlight or lines");
      }
      break;
  }
  if (!spectrum.entry().empty() && spectrum.source_case() != v1::Spectrum::kFile) {
    findings.add(field + ".entry", "entry is for spectra from a file");
  }
  if (spectrum.has_reading() && spectrum.source_case() != v1::Spectrum::kFile) {
    findings.add(field + ".reading", "reading is for spectra from a file");
  }
  check_lines(spectrum, field + ".line", role, findings);
  if (findings.size() == before) check_interpolation(spectrum, field + ".interpolation", findings);
}

}  // namespace metamer
