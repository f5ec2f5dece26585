#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>

namespace metamer {

/// What a scene and its settings can ask of a renderer and of a method, and not every one has.
enum class Feature : std::uint8_t {
  mirrors,           ///< Light that is reflected before it meets the surface that is seen.
  exact_fresnel,     ///< Fresnel terms of n and k, over nodes of the cosine.
  anisotropy,        ///< Models that look at tangents.
  corner_shading,    ///< Models at triangles' corners or middles: CONSTANT, GOURAUD, QUADRATIC.
  factors,           ///< What pixels are made of before any spectrum, kept for relighting.
  textures,          ///< Pictures on surfaces.
  area_lights,       ///< Lights that are surfaces: quads, disks, spheres.
  environment,       ///< Light from all around.
  planes,            ///< Objects that go on to the horizon.
  fluorescence,      ///< Light that becomes light of longer wavelengths at a surface.
  multi_pass,        ///< `point` by four wavelengths at a time.
  transmission,      ///< Light that is refracted, and absorbed on its way.
  lens,              ///< Cameras that are no pinholes.
  inter_reflection,  ///< Diffuse light that surfaces reflect to each other.
  normal_maps,       ///< Normals that pictures turn: normal and bump maps.
  alpha,             ///< Surfaces with holes, or that are there by a share.
};

/// Feature by feature, in the order of the enumeration: its name, as on the wire.
std::span<const char* const> feature_names();
inline const char* name_of(Feature feature) {
  return feature_names()[static_cast<std::size_t>(feature)];
}

/// A set of features.
class Features {
 public:
  constexpr Features(std::initializer_list<Feature> list) {
    for (const Feature feature : list) bits_ |= bit(feature);
  }
  static constexpr Features all() {
    Features set{};
    set.bits_ = bit(Feature::alpha) * 2 - 1;
    return set;
  }

  constexpr bool has(Feature feature) const { return (bits_ & bit(feature)) != 0; }
  constexpr Features without(Features others) const {
    others.bits_ = bits_ & ~others.bits_;
    return others;
  }

 private:
  static constexpr std::uint32_t bit(Feature feature) {
    return std::uint32_t{1} << static_cast<unsigned>(feature);
  }
  std::uint32_t bits_ = 0;
};

}  // namespace metamer
