#include "server/scene/compile.h"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/scene/light.h"
#include "common/scene/limits.h"
#include "common/scene/reflection.h"
#include "common/scene/settings.h"
#include "server/scene/environment/environment.h"
#include "server/scene/fluorescences.h"
#include "server/scene/light_parameters.h"
#include "server/scene/media.h"
#include "server/scene/object_compiler.h"
#include "server/scene/placement.h"
#include "server/scene/shining.h"
#include "server/scene/spectrum_lists.h"

namespace metamer {
namespace {

models::Reflection<float> to_f32(const models::Reflection<double>& from) {
  const auto numbers = [](const models::Reflection<double>::Parameters& list) {
    models::Reflection<float>::Parameters to;
    std::transform(list.begin(), list.end(), to.begin(),
                   [](double value) { return static_cast<float>(value); });
    return to;
  };
  models::Reflection<float> to{.model = from.model,
                               .parameters = numbers(from.parameters),
                               .diffuse = from.diffuse,
                               .diffuse_parameters = numbers(from.diffuse_parameters),
                               .slope_count = from.slope_count,
                               .attenuation = from.attenuation,
                               .roughness = static_cast<float>(from.roughness)};
  for (std::size_t i = 0; i < from.slope_count; ++i) {
    const auto& slope = from.slopes[i];
    to.slopes[i] = {slope.slope, static_cast<float>(slope.weight), numbers(slope.parameters)};
  }
  return to;
}

/// Builds one scene and gathers what is wrong with it.
class Compiler {
 public:
  Compiler(const v1::Scene& scene, const AssetReader& assets, const MeshImport& import,
           const TextureImport& textures, const SkyImport& skies,
           const std::atomic<bool>& cancelled)
      : to_{scene, assets},
        scene_(scene),
        result_(to_.result),
        import_(import),
        textures_(textures),
        skies_(skies ? skies : skies_of(assets)),
        cancelled_(cancelled) {}

  enum class Parts { all, appearance };
  tl::expected<RenderScene, std::vector<Problem>> run(Parts parts) {
    to_.problems = validate_scene(scene_);
    if (!to_.problems.empty()) return tl::unexpected(std::move(to_.problems));
    result_.camera = compile_camera(scene_.camera());
    result_.pixel_angle =
        2 * result_.camera.tan_half_fov / with_defaults(scene_.settings()).height();
    observer();
    result_.bounces = scene_.settings().bounces();
    for (int i = 0; i < scene_.light_size(); ++i) light(i);
    for (int i = 0; i < scene_.material_size(); ++i) material(i);
    for (int i = 0; i < scene_.material_size() && !cancelled_; ++i) {
      texture(i);
      maps(i);
    }
    if (to_.problems.empty()) to_.problems = add_fluorescences(scene_, to_.assets, result_);
    if (parts == Parts::all) objects();
    if (parts == Parts::all)
      if (auto fault = find_interfaces(result_, result_)) to_.problems.push_back(*std::move(fault));
    if (cancelled_ || !to_.problems.empty()) return tl::unexpected(std::move(to_.problems));
    if (parts == Parts::all)
      if (auto fault = find_shining(result_.lights, result_))
        return tl::unexpected(std::vector<Problem>{*std::move(fault)});
    return std::move(result_);
  }

 private:
  void observer() {
    auto loaded = load_observer(scene_.settings(), "settings", to_.assets);
    if (loaded)
      result_.observer = *std::move(loaded);
    else
      to_.problems.push_back(std::move(loaded.error()));
  }

  void objects() {
    ObjectCompiler compiler(mesh_needs_, to_);
    compiler.import_files(import_, cancelled_);
    for (int i = 0; i < scene_.object_size() && !cancelled_; ++i) compiler.object(i);
  }

  void light(int index) {
    const v1::Light& light = scene_.light(index);
    const std::string field = "light[" + std::to_string(index) + "]";
    if (light.has_environment()) return environment(light, field);
    if (light.has_object()) return shining_object(light, field);
    const ChosenLight chosen = chosen_light(light);
    result_.lights.push_back(
        {.name = light.name(),
         .field = field,
         .source =
             chosen.entry->has_area ? RenderLight::Source::surface : RenderLight::Source::place,
         .light = static_cast<lights::Light>(chosen.entry->index),
         .parameters = light_parameters(chosen),
         .reference_distance = light.reference_distance(),
         .luminance = light.has_luminance() ? light.luminance() : 1,
         .solid_angle = light.has_solid_angle() ? light.solid_angle() : std::numbers::pi,
         .emission = spectra_.emission(light.spectrum(), field + ".spectrum"),
         .visible = !light.has_visible() || light.visible()});
  }

  void shining_object(const v1::Light& light, const std::string& field) {
    const auto object =
        std::find_if(scene_.object().begin(), scene_.object().end(),
                     [&](const v1::Object& one) { return one.name() == light.object(); });
    result_.lights.push_back(
        {.name = light.name(),
         .field = field,
         .source = RenderLight::Source::object,
         .light = {},
         .parameters = {},
         .reference_distance = 0,
         .luminance = light.has_luminance() ? light.luminance() : 1,
         .solid_angle = std::numbers::pi,
         .emission = spectra_.emission(light.spectrum(), field + ".spectrum"),
         .visible = !light.has_visible() || light.visible(),
         .object = static_cast<std::uint32_t>(object - scene_.object().begin())});
  }

  void environment(const v1::Light& light, const std::string& field) {
    const std::uint32_t emission =
        light.has_spectrum() ? spectra_.emission(light.spectrum(), field + ".spectrum") : 0;
    auto added = add_environment(light, field, emission, skies_, result_);
    if (!added) to_.problems.push_back(std::move(added.error()));
  }

  void material(int index) {
    const v1::Material& material = scene_.material(index);
    const std::string field = "material[" + std::to_string(index) + "]";
    const bool exact = material.fresnel().has_dielectric() || material.fresnel().has_conductor();
    result_.materials.push_back(
        {.name = material.name(),
         .reflection = to_f32(reflection_of(material)),
         .fresnel = exact                              ? FresnelKind::exact
                    : material.fresnel().has_schlick() ? FresnelKind::schlick
                                                       : FresnelKind::none,
         .constants = exact ? spectra_.constants(material.fresnel(), field + ".fresnel") : 0,
         .diffuse = property(material.has_diffuse(), material.diffuse(), 0, field + ".diffuse"),
         .specular = property(material.has_specular(), material.specular(), 1, field + ".specular"),
         .mirror = static_cast<float>(material.mirror())});
    mesh_needs_.tangents |= result_.materials.back().anisotropic();
    mesh_needs_.uvs |= material.has_texture() || material.has_normal_map() ||
                       material.has_bump_map() || material.has_alpha();
    if (material.has_transmission()) medium(material.transmission(), field + ".transmission");
  }

  /// That of the newest material.
  void medium(const v1::Transmission& transmission, const std::string& field) {
    RenderMaterial& material = result_.materials.back();
    const auto number = static_cast<std::uint32_t>(result_.materials.size() - 1);
    const std::uint32_t transmittance =
        property(transmission.has_transmittance(), transmission.transmittance(), 1,
                 field + ".transmittance");
    material.medium =
        add_medium({.material = number,
                    .priority = transmission.priority(),
                    .index = index_at_d_line(result_.constants[material.constants].n),
                    .thickness = transmission.has_thickness() ? transmission.thickness() : 0.01,
                    .transmittance = transmittance,
                    .clear_shadow = transmission.shadow() == v1::Transmission::CLEAR,
                    .dispersion = transmission.dispersion()},
                   result_);
  }

  /// Its spectra become materials of their own, behind those of the scene: methods and relighting
  /// know them as any other.
  void texture(int index) {
    const v1::Material& material = scene_.material(index);
    if (!material.has_texture()) return;
    const v1::Texture& texture = material.texture();
    const std::string field = "material[" + std::to_string(index) + "].texture";
    auto picture = textures_(texture, PictureUse::texture, field);
    if (!picture) return to_.problems.push_back(std::move(picture.error()));
    if (result_.materials.size() + picture->channels > limits::max_materials)
      return to_.add(field + ".spectrum", "materials and spectra of textures are at most " +
                                              std::to_string(limits::max_materials) + " together");

    to_.note(picture->notes, field + ".file");
    const bool rgb = texture.use() == v1::Texture::RGB;
    RenderTexture to{PlacedPicture(*std::move(picture), texture), {}, !rgb};
    for (int i = 0; i < texture.spectrum_size(); ++i) {
      const std::string spectrum_field = field + ".spectrum[" + std::to_string(i) + "]";
      const std::string name = material.name() + "#" + std::to_string(i + 1);
      if (is_material(name))
        to_.add(spectrum_field, "the scene has a material " + quoted(name) +
                                    ", as this spectrum is called for relighting");
      to.materials.push_back(
          add_matte(name, spectra_.property(texture.spectrum(i), spectrum_field)));
    }
    for (std::size_t i = 0; rgb && i < 3; ++i)
      to.materials.push_back(
          add_matte(material.name() + "#" + "RGB"[i], spectra_.primary(i, field)));
    result_.materials[static_cast<std::size_t>(index)].texture =
        static_cast<std::uint32_t>(result_.textures.size());
    result_.textures.push_back(std::move(to));
  }

  void maps(int index) {
    const v1::Material& from = scene_.material(index);
    RenderMaterial& to = result_.materials[static_cast<std::size_t>(index)];
    const std::string field = "material[" + std::to_string(index) + "]";
    if (from.has_normal_map())
      to.normal_map = map(from.normal_map(), PictureUse::normals, field + ".normal_map");
    if (from.has_bump_map())
      to.bump_map = map(from.bump_map(), PictureUse::heights, field + ".bump_map");
    if (from.has_alpha()) to.alpha = map(from.alpha(), PictureUse::alpha, field + ".alpha");
  }

  std::optional<std::uint32_t> map(const v1::Map& map, PictureUse use, const std::string& field) {
    const v1::Texture texture = picture_of(map);
    auto picture = textures_(texture, use, field);
    if (!picture) {
      to_.problems.push_back(std::move(picture.error()));
      return std::nullopt;
    }
    to_.note(picture->notes, field + ".file");
    const double strength = map.has_strength() ? map.strength() : 1;
    const double span = double{picture->span};
    result_.maps.push_back(
        {PlacedPicture(*std::move(picture), texture), strength, span * strength,
         map.has_cutoff() ? std::optional(static_cast<float>(map.cutoff())) : std::nullopt});
    return static_cast<std::uint32_t>(result_.maps.size() - 1);
  }

  /// A material that no object has.
  std::uint32_t add_matte(const std::string& name, std::uint32_t diffuse) {
    result_.materials.push_back({.name = name,
                                 .reflection = to_f32(reflection_of(v1::Material())),
                                 .fresnel = FresnelKind::none,
                                 .constants = 0,
                                 .diffuse = diffuse,
                                 .specular = spectra_.property(1, {}),
                                 .mirror = 0});
    return static_cast<std::uint32_t>(result_.materials.size() - 1);
  }

  std::uint32_t property(bool given, const v1::Spectrum& message, double otherwise,
                         const std::string& field) {
    return given ? spectra_.property(message, field) : spectra_.property(otherwise, field);
  }

  bool is_material(const std::string& name) const {
    return std::any_of(scene_.material().begin(), scene_.material().end(),
                       [&](const v1::Material& material) { return material.name() == name; });
  }

  Compiling to_;
  const v1::Scene& scene_;
  RenderScene& result_;
  const MeshImport& import_;
  const TextureImport& textures_;
  const SkyImport skies_;
  const std::atomic<bool>& cancelled_;
  SpectrumLists spectra_{to_};
  MeshNeeds mesh_needs_;
};

}  // namespace

tl::expected<RenderScene, std::vector<Problem>> compile_scene(
    const v1::Scene& scene, const AssetReader& assets, const MeshImport& meshes,
    const TextureImport& textures, const std::atomic<bool>& cancelled, const SkyImport& skies) {
  return Compiler(scene, assets, meshes, textures, skies, cancelled).run(Compiler::Parts::all);
}

tl::expected<RenderScene, std::vector<Problem>> compile_appearance(const v1::Scene& scene,
                                                                   const AssetReader& assets,
                                                                   const TextureImport& textures,
                                                                   const SkyImport& skies) {
  const std::atomic<bool> never = false;
  return Compiler(scene, assets, MeshImport(), textures, skies, never)
      .run(Compiler::Parts::appearance);
}

RenderCamera compile_camera(const v1::Camera& camera) {
  const Eigen::Vector3d up = camera.has_up() ? to_vector(camera.up()) : Eigen::Vector3d::UnitY();
  RenderCamera to;
  to.eye = to_vector(camera.eye());
  to.forward = unit(to_vector(camera.target()) - to.eye);
  to.right = unit(to.forward.cross(scaled_by_two_to(-exponent_of(up), up)));
  to.up = to.right.cross(to.forward);
  const double fov = camera.has_vertical_fov() ? camera.vertical_fov() : 35;
  to.tan_half_fov = std::tan(fov * std::numbers::pi / 360);
  to.aperture_radius = camera.aperture_radius();
  to.focus_distance = camera.has_focus_distance() ? camera.focus_distance()
                                                  : (to_vector(camera.target()) - to.eye).norm();
  return to;
}

}  // namespace metamer
