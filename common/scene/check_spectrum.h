#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/scene/findings.h"
#include "common/scene/validate.h"
#include "common/spectral/interpolation.h"

namespace metamer {

/// Adds what is wrong with a spectrum as far as the message itself shows it: everything for
/// constants, samples and standards, the names for files.
void check_spectrum(const v1::Spectrum& spectrum, const std::string& field, SpectrumRole role,
                    Findings& findings);

/// What is wrong with a value, "a property must lie in 0..1"; empty: nothing.
std::string value_fault(double value, SpectrumRole role);

/// The curve that a message asks for; nothing: the recommended one.
std::optional<Interpolation> interpolation_of(const v1::Spectrum& spectrum);

/// A message's samples, which are sound.
Spectrum to_spectrum(const v1::Samples& samples);

/// True when no value is above 0: an emission of which no light comes.
bool is_dark(const std::vector<double>& values);

}  // namespace metamer
