#pragma once

#include <string>
#include <string_view>

#include "common/spectral/observer.h"

namespace metamer {

/// Reads an observer from a file of three spectra, in any of read_spectrum_file's formats: a table
/// of wavelengths, x̄, ȳ and z̄ as the CIE and the CVRL publish them, or CGATS. Where their names
/// begin with x, y and z, in whatever case and order, they are that; else they are x̄, ȳ and z̄ as
/// they stand there. The observer is named `file`. Errors: those of read_spectrum_file, other than
/// three spectra, observer_fault.
Result<Observer> parse_observer(std::string_view bytes, const std::string& file);

}  // namespace metamer
