#pragma once

#include <algorithm>
#include <cmath>

#include "common/transport/factor_sources.h"
#include "common/transport/factor_table.h"

namespace metamer::factors {

/// Beer's law with an absorption of 1 − C_D: exp(−(1 − C_D) d), at the optical lengths d = node/16.
struct Toy {
  struct Table {
    static constexpr std::uint32_t nodes = 65;
    static FactorTable make(const Spectrum& diffuse, const std::vector<double>& nm) {
      return [at = resample(diffuse, nm, Outside::hold).values](std::uint32_t node) {
        std::vector<double> values = at;
        for (double& value : values) value = std::exp(-(1 - value) * node / 16);
        return values;
      };
    }
  };
  static std::size_t count(const FactorSources& sources) { return sources.materials.size(); }
  static const Spectrum* source(const FactorSources& sources, std::uint32_t material) {
    return sources.materials[material].diffuse;
  }

  struct Place {
    std::uint32_t below;
    float fraction;
  };
  static Place place(float length) {
    const float t = 16 * length;
    const auto below = static_cast<std::uint32_t>(std::min(t, 63.0f));
    return {below, t - static_cast<float>(below)};
  }
};

}  // namespace metamer::factors
