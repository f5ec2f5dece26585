#include "client/tools/scene/light_names.h"

#include <algorithm>

#include "common/problem.h"

namespace metamer::client {
namespace {

bool means(const std::string& name, const std::string& light) {
  return name == all_lights || name == light;
}

}  // namespace

std::optional<std::size_t> name_for(const std::string& light,
                                    const std::vector<std::string>& names) {
  for (std::size_t i = names.size(); i-- > 0;)
    if (means(names[i], light)) return i;
  return std::nullopt;
}

std::string no_effect(const std::vector<std::string>& names,
                      const std::vector<std::string>& lights) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto is_meant = [&](const std::string& light) { return means(names[i], light); };
    const auto counts = [&](const std::string& light) { return name_for(light, names) == i; };
    if (std::none_of(lights.begin(), lights.end(), is_meant) ||
        std::any_of(lights.begin(), lights.end(), counts))
      continue;
    return quoted(names[i]) + " has no effect: " +
           (names[i] == all_lights ? "after it each light is named by itself"
                                   : quoted(all_lights) + " after it means all lights");
  }
  return {};
}

}  // namespace metamer::client
