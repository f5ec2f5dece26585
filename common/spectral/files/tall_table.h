#pragma once

#include <string>

#include "common/spectral/files/contents.h"
#include "common/spectral/files/rows.h"

namespace metamer::spectrum_text {

/// A table whose lines are wavelengths, and whose columns are spectra.
Result<Contents> read_tall(const Lines& lines, const Dialect& dialect, const std::string& file);

}  // namespace metamer::spectrum_text
