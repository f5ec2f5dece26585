#pragma once

#include "common/transport/factor.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// What a mirror of the `index`-th material does to light that meets it at `cosine`: its Fresnel
/// term, C_S where it has none.
inline Factor mirror_factor(const RenderMaterial& material, std::uint32_t index, float cosine) {
  switch (material.fresnel) {
    case FresnelKind::none:
      break;
    case FresnelKind::schlick:
      return {FactorKind::specular, index, cosine};
    case FresnelKind::exact:
      return {FactorKind::fresnel, index, cosine};
  }
  return {FactorKind::specular, index, 1};
}

}  // namespace metamer
