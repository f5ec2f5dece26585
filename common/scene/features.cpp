#include "common/scene/features.h"

namespace metamer {

std::span<const char* const> feature_names() {
  static constexpr const char* names[] = {
      "mirrors", "exact_fresnel",    "anisotropy",  "corner_shading",
      "factors", "textures",         "area_lights", "environment",
      "planes",  "fluorescence",     "multi_pass",  "transmission",
      "lens",    "inter_reflection", "normal_maps", "alpha"};
  return names;
}

}  // namespace metamer
