#pragma once

#include "common/transport/factor.h"
#include "server/models/lanes.h"
#include "server/scene/render_scene.h"
#include "server/transport/gather.h"

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

/// The way on over the mirror of a surface that `chain` leads to. Of `weight` is left what the
/// mirror and, of a rough surface, its masking leave; what of it depends on wavelength is on the
/// chain.
inline std::uint32_t over_mirror(Gather& gather, std::uint32_t chain,
                                 const RenderMaterial& material, std::uint32_t index, float cosine,
                                 float& weight) {
  chain = gather.chain(chain, mirror_factor(material, index, cosine));
  weight *= material.mirror;
  if (!material.has(models::diffracting)) return chain;
  const models::RoughMirrorF32 rough = models::rough_mirror(material.reflection.parameters, cosine);
  weight *= rough.masking;
  return gather.chain(chain, {FactorKind::coherent, index, rough.depth});
}

}  // namespace metamer
