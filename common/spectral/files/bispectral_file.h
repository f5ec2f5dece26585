#pragma once

#include <string>
#include <string_view>

#include "common/spectral/fluorescence.h"

namespace metamer {

/// Reads a bispectral matrix, laid out as `Fluorescence.file` says (fluorescence.proto): a table
/// whose first line has the emission's wavelengths and whose first column those of excitation, in
/// any order; # begins a comment. Errors name `file`, line and column: another number of cells, a
/// cell that is no number, below 0 or NaN; a wavelength twice, or out of 300 to 830 nm (excitation)
/// or of 1 to 10,000 nm (emission); one row or column alone; re-radiation at a shorter wavelength
/// than is absorbed, but in the cell that the diagonal passes; more than max_bispectral_cells.
Result<BispectralMatrix> read_bispectral_file(std::string_view bytes, const std::string& file);

/// Whether a file says that it is one: its first cell says "excitation".
bool is_bispectral(std::string_view bytes);

}  // namespace metamer
