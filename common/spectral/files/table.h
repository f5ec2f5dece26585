#pragma once

#include <string>
#include <string_view>

#include "common/spectral/files/contents.h"

namespace metamer::spectrum_text {

/// A table of spectra as spectrum_file.h says, `text` in UTF-8. It must outlive the result.
Result<Contents> read_table(std::string_view text, const std::string& file);

}  // namespace metamer::spectrum_text
