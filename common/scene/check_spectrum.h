#pragma once

#include <string>
#include <vector>

#include "common/scene/findings.h"
#include "common/scene/validate.h"

namespace metamer {

/// Adds what is wrong with a spectrum as far as the message itself shows it: everything for
/// constants, samples and standards, the names for files.
void check_spectrum(const v1::Spectrum& spectrum, const std::string& field, SpectrumRole role,
                    Findings& findings);

/// What is wrong with a value, "a property must lie in 0..1"; empty: nothing.
std::string value_fault(double value, SpectrumRole role);

/// True when no value is above 0: an emission of which no light comes.
bool is_dark(const std::vector<double>& values);

}  // namespace metamer
