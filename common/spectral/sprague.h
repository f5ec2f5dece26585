#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/spectral/spectrum.h"

namespace metamer {

/// Sprague's interpolation, a polynomial of the fifth degree between two samples whose first two
/// derivatives are those of the data (T. B. Sprague, Journal of the Institute of Actuaries 22, 270,
/// 1880), as CIE 167:2005 recommends it for uniform tables, with the samples beyond the ends that
/// it gives. The result is the values at `nm`, which lie between the first sample and the last;
/// where one meets a sample, that sample's, to the bit. Errors: fewer than 6 samples, samples that
/// are not uniform to 1e-6 of their step.
Result<std::vector<double>> sprague(const Spectrum& samples, const std::vector<double>& nm);

/// Whether Sprague's interpolation takes it; what is wrong with it, or nothing.
std::optional<std::string> sprague_fault(const Spectrum& samples);

}  // namespace metamer
