#pragma once

#include <string>
#include <string_view>

#include "common/spectral/files/contents.h"

namespace metamer::spectrum_text {

/// CxF3 (ISO 17972-1) and IES TM-27-14, told apart by their outermost element, `text` in UTF-8.
/// Namespaces' prefixes do not count. Errors name the line; the text must outlive the result.
Result<Contents> read_xml(std::string_view text, const std::string& file);

}  // namespace metamer::spectrum_text
