#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

/// Lights by the names that options give: "*" means all of them, and a later name goes before.
namespace metamer::client {

inline constexpr const char* all_lights = "*";

/// Which of the names a light goes by: the last that means it. Nothing: none does.
std::optional<std::size_t> name_for(const std::string& light,
                                    const std::vector<std::string>& names);

/// What is to be said where later names take every light from an earlier one: "\"*\" has no effect:
/// …". Empty: none does; names that mean no light are somebody else's to refuse.
std::string no_effect(const std::vector<std::string>& names,
                      const std::vector<std::string>& lights);

}  // namespace metamer::client
