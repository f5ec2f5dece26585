#pragma once

#include "common/spectral/spectrum.h"

namespace metamer {

/// Sprague's interpolation, a polynomial of the fifth degree between two samples whose first two
/// derivatives are those of the data (T. B. Sprague, Journal of the Institute of Actuaries 22, 270,
/// 1880), as CIE 167:2005 recommends it for uniform tables, with the samples beyond the ends that
/// it gives. The result is at the first sample and every `step` nm from there to the last; where
/// that meets a sample it is the sample, to the bit. Errors: fewer than 6 samples, samples that are
/// not uniform to 1e-6 of their step, the errors of Wavelengths::uniform.
Result<Spectrum> sprague(const Spectrum& spectrum, double step);

}  // namespace metamer
