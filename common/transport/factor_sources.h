#pragma once

#include <vector>

#include "common/scene/fresnel.h"
#include "common/spectral/spectrum.h"

namespace metamer {

/// What a scene's factors are made of. Factors with the same source have the same values. All that
/// is pointed to outlives it.
struct FactorSources {
  struct Material {
    const Spectrum* diffuse;
    const Spectrum* specular;
    const OpticalConstants* constants;  ///< Null where its Fresnel term is not exact.
  };
  std::vector<Material> materials;
};

}  // namespace metamer
