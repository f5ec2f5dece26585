#include "server/plan/reference.h"

#include <cmath>

#include "server/methods/exact.h"

namespace metamer {

Reference::Reference(const RenderScene& scene, cie::Observer observer)
    : scene_(scene),
      observer_(observer_weights(observer, observer_wavelengths())),
      bands_(observer_wavelengths().size()) {
  const Wavelengths wavelengths = observer_wavelengths();
  bool has_white = false;
  for (const RenderLight& light : scene.lights) {
    Values power =
        resample(scene.emissions[light.emission], wavelengths.nm(), Outside::zero).values;
    const double scale = luminance_scale(observer_, power, light.luminance);
    for (double& value : power) value *= scale;
    if (!has_white && scale > 0) {
      white_ = to_xyz(observer_, power);
      has_white = true;
    }
    lights_.push_back(std::move(power));
  }
  for (const Spectrum& property : scene.properties)
    properties_.push_back(resample(property, wavelengths.nm(), Outside::hold).values);
  for (const OpticalConstants& constants : scene.constants)
    constants_.push_back(metamer::resample(constants, wavelengths.nm()));
}

Xyz Reference::resolve(const Gather& gather, double scale) {
  const auto paths = gather.paths();
  std::vector<Values> carriers(paths.size(), Values(bands_));
  const auto surfaces = gather.surfaces();
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    add_surface(gather, s, carriers[surfaces[s].path]);
  for (const Gather::FresnelWeight& one : gather.fresnel()) {
    const Gather::Surface& surface = surfaces[one.surface];
    const Values& row = fresnel_row(scene_.materials[surface.material].constants, one.node);
    for (std::size_t i = 0; i < bands_; ++i)
      carriers[surface.path][i] += double{one.weight} * lights_[one.light][i] * row[i];
  }
  for (std::size_t path = paths.size(); path-- > 1;) {
    const Values factor = mirror(paths[path]);
    for (std::size_t i = 0; i < bands_; ++i)
      carriers[paths[path].parent][i] += carriers[path][i] * factor[i];
  }
  Xyz xyz = to_xyz(observer_, carriers[0]);
  for (double& value : xyz) value *= scale;
  return xyz;
}

void Reference::add_surface(const Gather& gather, std::size_t surface, Values& carrier) const {
  const RenderMaterial& material = scene_.materials[gather.surfaces()[surface].material];
  const Values& diffuse = properties_[material.diffuse];
  const Values& specular = properties_[material.specular];
  const auto weights = gather.weights(surface);
  for (std::size_t light = 0; light < weights.size(); ++light) {
    const LobeWeights& w = weights[light];
    if (w.diffuse == 0 && w.specular == 0 && w.white == 0) continue;
    for (std::size_t i = 0; i < bands_; ++i)
      carrier[i] += lights_[light][i] * (double{w.diffuse} * diffuse[i] +
                                         double{w.specular} * specular[i] + double{w.white});
  }
}

/// An exact Fresnel term lies on the line between two nodes, within 2e-5 (fresnel_table.h).
Reference::Values Reference::mirror(const Gather::Path& path) {
  const RenderMaterial& material = scene_.materials[path.material];
  switch (material.fresnel) {
    case FresnelKind::none:
      break;
    case FresnelKind::schlick: {
      Values factor = properties_[material.specular];
      const double rise = std::pow(1 - double{path.cosine}, 5);
      for (double& value : factor) value += (1 - value) * rise;
      return factor;
    }
    case FresnelKind::exact: {
      const FresnelPlace place = fresnel_place(path.cosine);
      Values factor = fresnel_row(material.constants, place.below);
      const Values& above = fresnel_row(material.constants, place.below + 1);
      for (std::size_t i = 0; i < bands_; ++i)
        factor[i] += double{place.fraction} * (above[i] - factor[i]);
      return factor;
    }
  }
  return properties_[material.specular];
}

const Reference::Values& Reference::fresnel_row(std::uint32_t constants, std::uint32_t node) {
  const auto [place, is_new] = fresnel_rows_.try_emplace({constants, node});
  if (is_new) place->second = fresnel_at(constants_[constants], fresnel_node(node));
  return place->second;
}

}  // namespace metamer
