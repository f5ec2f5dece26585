#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/lights/registry.h"
#include "common/mesh/triangle_mesh.h"
#include "common/models/reflection.h"
#include "common/scene/fresnel.h"
#include "common/spectral/cie.h"
#include "common/spectral/fluorescence.h"
#include "server/scene/environment/sky_picture.h"
#include "server/scene/environment/sky_tables.h"
#include "server/scene/map.h"
#include "server/scene/texture.h"

namespace metamer {

struct RenderCamera {
  Eigen::Vector3d eye;
  Eigen::Vector3d forward, right, up;  ///< Orthonormal.
  double tan_half_fov;                 ///< Of the vertical field of view.
  double aperture_radius = 0;          ///< Of a thin lens around the eye; 0: a pinhole.
  double focus_distance = 1;           ///< Of the plane that is sharp, along `forward`.
};

/// What a pixel's gather knows by an index: an emission of one luminance, and where it comes from.
struct RenderLight {
  enum class Source : unsigned char {
    place,        ///< A place or a direction: one ray finds it.
    surface,      ///< It shines from each of its points.
    object,       ///< The same, and is an object of the scene.
    environment,  ///< It shines from all directions: RenderScene::environment has how much.
  };
  std::string name;
  std::string field;  ///< Of the scene: "light[0]".
  Source source = Source::place;
  lights::Light light;  ///< Its line in lights.def; an object and an environment have none.
  lights::Values<double> parameters;  ///< Behind the place of its reference distance.
  double reference_distance;          ///< 0: the luminance holds at every distance.
  double luminance;
  double solid_angle;      ///< sr
  std::uint32_t emission;  ///< Index into RenderScene::emissions.
  /// That of the whole, where it is one part of what shines; else the same.
  std::uint32_t own_emission = emission;
  bool visible = true;       ///< To the eye; mirrors show what shines in any case.
  std::uint32_t object = 0;  ///< Index into RenderScene::objects, of one that is an object.

  /// Its struct in the shaders, flat.
  lights::Values<double> values() const {
    lights::Values<double> all = parameters;
    all[0] = reference_distance * reference_distance;
    return all;
  }
};

enum class FresnelKind : unsigned char {
  none,     ///< `specular` is in its place.
  schlick,  ///< E[2.2-12], `specular` at normal incidence.
  exact,    ///< Of n and k.
};

struct RenderMaterial {
  std::string name;
  models::Reflection<float> reflection;
  FresnelKind fresnel;
  std::uint32_t constants;          ///< Index into RenderScene::constants, where it is exact.
  std::uint32_t diffuse, specular;  ///< Indices into RenderScene::properties.
  float mirror;  ///< Weight of the mirror reflection, coloured by the Fresnel term.
  /// Index into RenderScene::textures; its spectra and `diffuse` share the diffuse lobe.
  std::optional<std::uint32_t> texture = {};
  std::optional<std::uint32_t> normal_map = {}, bump_map = {}, alpha = {};  ///< RenderScene::maps.
  std::uint32_t medium = 0;  ///< Of what its objects enclose, in RenderScene::media; 0: opaque.
  std::optional<std::uint32_t> fluorescence = {};  ///< Index into RenderScene::fluorescences.

  bool turns_normals() const { return normal_map || bump_map; }
  bool has_picture() const { return texture || turns_normals() || alpha; }
  bool has(models::Trait trait) const { return models::entry(reflection.model).traits & trait; }
  bool anisotropic() const;
};

/// What objects of a clear material enclose, or the air about them.
struct RenderMedium {
  std::uint32_t material = 0;       ///< Not of air.
  std::int32_t priority = 0;        ///< Where objects overlap, the higher one's; then the lower
                                    ///< material's.
  double index = 1;                 ///< n at the d line.
  double optical_depth = 0;         ///< Of `thickness`, where it is absorbed most; 0: clear.
  double weakest = 0;               ///< The least depth of any wavelength, relative to that.
  double thickness = 1;             ///< metres
  std::uint32_t transmittance = 0;  ///< Index into RenderScene::properties, where it absorbs.
  bool clear_shadow = true;         ///< Light reaches what is behind it.
  bool dispersion = false;          ///< Each of RenderScene::windows goes a way of its own.
};

/// Where two media may touch.
struct RenderInterface {
  std::uint32_t rare, dense;  ///< By their n at the d line.
  std::uint32_t constants;    ///< The denser one's n by the other's, in RenderScene::constants.
};

/// Light from all around. A picture has a light each for its red, green and blue, or its bands.
struct RenderEnvironment {
  std::string field;                          ///< Of the scene: "light[0]".
  std::uint32_t first_light = 0;              ///< Index into RenderScene::lights.
  std::shared_ptr<const SkyPicture> picture;  ///< Null: alike in all directions, one light.
  std::shared_ptr<const SkyTables> tables;    ///< Of the picture.
  double rotation = 0;                        ///< About +y, radians.
  bool visible = true;                        ///< To the eye.

  std::uint32_t light_count() const {
    return picture ? static_cast<std::uint32_t>(picture->parts()) : 1;
  }
};

struct RenderObject {
  /// A sphere is the unit sphere, a plane what has y = 0, placed by their transforms.
  enum class Shape { mesh, sphere, plane };
  std::string name;
  Shape shape;
  std::uint32_t mesh;  ///< Index into RenderScene::meshes, for a mesh.
  std::uint32_t material;
  v1::Shading shading;
  Eigen::Affine3d to_world;
  /// Of a mesh that shines: shares of its area, those of the triangles up to and with each.
  std::shared_ptr<const std::vector<double>> area_up_to = {};
};

/// A scene as a backend wants it: flat arrays, every name resolved to an index, every spectrum
/// loaded once. Holds nothing of methods, wavelengths or threads. Immutable once compiled.
struct RenderScene {
  RenderCamera camera;
  Observer observer = cie::observer_1931();
  /// How often surfaces light each other, as the settings ask for.
  std::uint32_t bounces = 0;
  std::vector<RenderLight> lights;
  std::optional<RenderEnvironment> environment;
  std::vector<RenderMaterial> materials;  ///< Those of the scene, then the spectra of textures.
  std::vector<RenderTexture> textures;
  std::vector<RenderMap> maps;  ///< Of materials: what is no colour.
  std::vector<RenderObject> objects;
  std::vector<TriangleMesh> meshes;         ///< Distinct files and quads.
  std::vector<Spectrum> emissions;          ///< Distinct spectra of the lights, relative power.
  std::vector<Spectrum> properties;         ///< Distinct spectra of the materials, 0..1.
  std::vector<OpticalConstants> constants;  ///< Distinct ones of the exact Fresnel terms.
  std::vector<RenderMedium> media;          ///< Those of materials behind air; else empty.
  std::vector<RenderInterface> interfaces;  ///< As far as objects touch (find_interfaces).
  std::vector<Spectrum> windows;            ///< Bundles of wavelengths; none: all go the same way.
  double pixel_angle = 1e-3;                ///< Of the settings, radians.
  std::vector<Fluorescence> fluorescences;  ///< Distinct ones of the materials.

  /// What fluorescences make of emissions: lights, which a factor reradiate has in the place of the
  /// scene's. By emission, then fluorescence.
  struct Reradiated {
    Spectrum power;        ///< Of a light of luminance 1.
    double luminance = 0;  ///< Its own.
  };
  std::vector<Reradiated> reradiated;
  std::size_t reradiated_index(std::uint32_t light, std::uint32_t fluorescence) const {
    return lights[light].emission * fluorescences.size() + fluorescence;
  }
  /// The material has a fluorescence.
  const Reradiated& reradiated_by(std::uint32_t light, std::uint32_t material) const {
    return reradiated[reradiated_index(light, *materials[material].fluorescence)];
  }

  /// Some material is not there as a whole: rays pass its surfaces.
  bool has_alpha() const {
    return std::any_of(materials.begin(), materials.end(),
                       [](const RenderMaterial& material) { return material.alpha.has_value(); });
  }

  /// The field of the scene that a spectrum was first named in: "material[3].diffuse".
  std::vector<std::string> emission_fields, property_fields, constants_fields, fluorescence_fields;

  /// What files were taken for where nobody says it.
  struct Notice {
    std::string field, message;
  };
  std::vector<Notice> notices;

  std::uint64_t triangle_count() const {
    std::uint64_t n = 0;
    for (const auto& mesh : meshes) n += mesh.triangles.size();
    return n;
  }
};

/// The materials that objects have, with those of their textures.
std::set<std::uint32_t> seen_materials(const RenderScene& scene);
/// Whether light is absorbed within a material's objects.
inline bool absorbs(const RenderScene& scene, const RenderMaterial& material) {
  return material.medium > 0 && scene.media[material.medium].optical_depth > 0;
}

/// Which of the angles that cost something a scene's models look at.
struct NeededAngles {
  bool azimuth = false, tangent = false;
};
inline NeededAngles needed_angles(const RenderScene& scene) {
  NeededAngles needed;
  for (const RenderMaterial& material : scene.materials) {
    needed.azimuth |= material.reflection.diffuse != models::DiffuseTerm::lambert;
    needed.tangent |= material.anisotropic();
  }
  return needed;
}

inline bool RenderMaterial::anisotropic() const {
  if (has(models::anisotropic)) return true;
  for (std::size_t i = 0; i < reflection.slope_count; ++i)
    if (models::entry(reflection.slopes[i].slope).traits & models::anisotropic) return true;
  return false;
}

}  // namespace metamer
