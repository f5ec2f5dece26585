#pragma once

#include <unistd.h>

#include <span>
#include <string_view>
#include <vector>

namespace metamer::service {

/// Those variables of our own environment that begin so, for a child; null at the end. The rest may
/// hold anybody's secrets.
inline std::vector<char*> kept_environment(std::span<const std::string_view> kept) {
  std::vector<char*> environment;
  for (char** variable = environ; *variable != nullptr; ++variable)
    for (const std::string_view name : kept)
      if (std::string_view(*variable).starts_with(name)) {
        environment.push_back(*variable);
        break;
      }
  environment.push_back(nullptr);
  return environment;
}

}  // namespace metamer::service
