#pragma once

#include <string>
#include <vector>

#include "common/problem.h"
#include "common/spectral/spectrum_file.h"
#include "common/spectral/tokens.h"

namespace metamer::spectrum_text {

/// The spectra of a CGATS file (ISO 28178, with Argyll's SPECTRAL_… keywords), from its first word
/// on. See parse_spectra, which calls it.
Result<std::vector<NamedSpectrum>> read_cgats(Tokens tokens, const std::string& file);

}  // namespace metamer::spectrum_text
