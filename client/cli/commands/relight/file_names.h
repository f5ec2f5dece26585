#pragma once

#include <string>
#include <vector>

#include "client/cli/commands/relight/variants.h"

/// How the files of several pictures are called.
namespace metamer::cli {

/// `pattern` with the labels in the place of {light} and {material}: "lamps warm" as "lamps-warm".
std::string file_name(const std::string& pattern, const Variant& light, const Variant& material);

/// The files of all pictures. Errors: one that would be written several times, as it has no {light}
/// or {material}, or as two variants have one label.
Result<std::vector<std::string>> file_names(const std::vector<std::string>& patterns,
                                            const std::vector<Variant>& lights,
                                            const std::vector<Variant>& materials);

}  // namespace metamer::cli
