#pragma once

#include <string>
#include <string_view>

namespace metamer {

/// A text as roff, the language of man pages, shows it: hyphens stay hyphens, and no line is taken
/// for a request.
std::string roff(std::string_view text);

}  // namespace metamer
