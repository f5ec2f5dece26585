#pragma once

#include <vector>

#include "common/scene/fresnel.h"
#include "common/spectral/fluorescence.h"
#include "common/spectral/spectrum.h"

namespace metamer {

/// What a scene's factors are made of. Factors with the same source have the same values. All that
/// is pointed to outlives it.
struct FactorSources {
  struct Material {
    const Spectrum* diffuse;
    const Spectrum* specular;
    const OpticalConstants* constants;           ///< Null where its Fresnel term is not exact.
    const Spectrum* transmittance = nullptr;     ///< Null where it absorbs nothing.
    const Fluorescence* fluorescence = nullptr;  ///< Null where it has none.
    bool is_rough = false;  ///< Of He's model: it has lobes, and its mirror loses light.
  };
  std::vector<Material> materials;
  /// Where two media touch: n of the denser one (at the d line) by that of the other. No k.
  std::vector<const OpticalConstants*> interfaces;
  std::vector<const Spectrum*> windows;  ///< Bundles of wavelengths, whose sum is 1.
};

}  // namespace metamer
