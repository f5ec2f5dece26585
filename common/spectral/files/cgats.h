#pragma once

#include <string>
#include <string_view>

#include "common/spectral/files/contents.h"

namespace metamer::spectrum_text {

/// The spectra of a CGATS file (ISO 28178, with Argyll's SPECTRAL_… keywords) from its first word
/// on; `text` is all of it, and must outlive the result. Keywords are read in any case.
Result<Contents> read_cgats(Tokens tokens, std::string_view text, const std::string& file);

}  // namespace metamer::spectrum_text
