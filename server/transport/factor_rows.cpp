#include "server/transport/factor_rows.h"

#include "common/scene/fresnel_table.h"
#include "server/models/lanes.h"

namespace metamer {

FactorRows::FactorRows(const RenderScene& scene) {
  const auto properties = static_cast<std::uint32_t>(scene.properties.size());
  for (const RenderMaterial& material : scene.materials)
    surfaces_.push_back({material.fresnel, 1 + material.diffuse, 1 + material.specular,
                         1 + properties + material.constants * fresnel_nodes});
  size_ = 1 + properties + static_cast<std::uint32_t>(scene.constants.size()) * fresnel_nodes;
}

FactorRows::Factor FactorRows::mirror(std::uint32_t material, float cosine) const {
  const Surface& own = surfaces_[material];
  switch (own.fresnel) {
    case FresnelKind::none:
      break;
    case FresnelKind::schlick: {
      const float rise = models::schlick_rise(cosine);
      return {{own.specular, white}, {1 - rise, rise}, 2};
    }
    case FresnelKind::exact: {
      const FresnelPlace place = fresnel_place(cosine);
      const std::uint32_t below = own.first_node + place.below;
      return {{below, below + 1}, {1 - place.fraction, place.fraction}, 2};
    }
  }
  return {{own.specular, white}, {1, 0}, 1};
}

void FactorRows::for_each(
    const RenderScene& scene, const std::vector<double>& nm,
    const std::function<void(std::uint32_t row, std::vector<double> values)>& take) const {
  take(white, std::vector<double>(nm.size(), 1.0));
  std::uint32_t row = white + 1;
  for (const Spectrum& property : scene.properties)
    take(row++, resample(property, nm, Outside::hold).values);
  for (const OpticalConstants& constants : scene.constants) {
    const ConstantsAt at = resample(constants, nm);
    for (std::uint32_t node = 0; node < fresnel_nodes; ++node)
      take(row++, fresnel_at(at, fresnel_node(node)));
  }
}

}  // namespace metamer
