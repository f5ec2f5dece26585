#pragma once

#include <string>
#include <string_view>

namespace metamer {

/// `text` as a terminal or a log may show it, whoever wrote it: each control character (C0 but for
/// those of `keep`, DEL, C1), each line or paragraph separator, each mark that turns the direction
/// of writing, and each byte that is not UTF-8 comes out as `?`.
std::string printable(std::string_view text, std::string_view keep = {});

}  // namespace metamer
