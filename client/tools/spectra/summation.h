#pragma once

#include "common/spectral/spectrum.h"
#include "common/spectral/wavelengths.h"

/// At which wavelengths sums over a spectrum are taken.
namespace metamer::client {

/// Where to sum E[3.2-2] of a light: at its own samples where they are 5 nm apart at most, as the
/// CIE does with its tables; else as below.
Wavelengths own_wavelengths(const Spectrum& light);

/// At every nm from 360 to 830, as the renderer's reference, and wherever the light itself has
/// samples there, so that no line falls between. Where that is more than Wavelengths::max_count,
/// at its samples alone.
Wavelengths fine_wavelengths(const Spectrum& light);

}  // namespace metamer::client
