#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/color/usable_white.h"
#include "server/methods/method.h"

namespace metamer {

/// How far a method is off on one light, looked at without mirrors.
struct LightError {
  std::uint32_t light;
  bool seen;        ///< The observer sees something of it.
  bool dark;        ///< The method makes nothing of it.
  double white;     ///< ΔE00 of a perfect white.
  double material;  ///< The largest ΔE00 of a material's diffuse and specular spectra; 0 of none.
  std::uint32_t worst = 0;  ///< The material.
};

/// The colours of a scene's materials under each of its lights by itself, integrated in f64: what
/// methods are compared with before anything is rendered. Each light's own white is white, equal
/// energy where a light has next to none of X, Y or Z. Of more than 16384 pairs, materials are left
/// out evenly.
class DirectColors {
 public:
  DirectColors(const RenderScene& scene, const Observer& observer);

  /// For each light of a luminance above 0.
  std::vector<LightError> errors(const Method& method) const;

 private:
  struct Pair {
    std::uint32_t light, material;
    FactorNode factor;
    Xyz xyz;  ///< Of luminance 1.
  };
  const RenderScene& scene_;
  std::vector<Xyz> whites_;  ///< By light, of luminance 1; 0 where it is not seen.
  std::vector<Pair> pairs_;
};

}  // namespace metamer
