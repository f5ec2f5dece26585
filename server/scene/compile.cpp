#include "server/scene/compile.h"

#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "common/color/rgb_reflectance.h"
#include "common/scene/light.h"
#include "common/scene/limits.h"
#include "common/scene/reflection.h"
#include "common/scene/settings.h"
#include "common/spectral/lines.h"
#include "server/scene/environment.h"
#include "server/scene/light_parameters.h"
#include "server/scene/media.h"
#include "server/scene/placement.h"

namespace metamer {
namespace {

/// Of an ellipsoid: rays in its own space, too, have to keep to limits::max_coordinate.
constexpr double max_axis_ratio = 1e16;

/// A number as people write it: 60, 0.5, 1e+06.
std::string shown(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

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
           const TextureImport& textures, const std::atomic<bool>& cancelled)
      : scene_(scene),
        assets_(assets),
        import_(import),
        textures_(textures),
        cancelled_(cancelled) {}

  enum class Parts { all, appearance };
  tl::expected<RenderScene, std::vector<Problem>> run(Parts parts) {
    problems_ = validate_scene(scene_);
    if (!problems_.empty()) return tl::unexpected(std::move(problems_));
    result_.camera = compile_camera(scene_.camera());
    result_.pixel_angle =
        2 * result_.camera.tan_half_fov / with_defaults(scene_.settings()).height();
    observer();
    for (int i = 0; i < scene_.light_size(); ++i) light(i);
    for (int i = 0; i < scene_.material_size(); ++i) material(i);
    for (int i = 0; i < scene_.material_size() && !cancelled_; ++i) texture(i);
    if (parts == Parts::all) import_files();
    if (parts == Parts::all)
      for (int i = 0; i < scene_.object_size() && !cancelled_; ++i) object(i);
    if (parts == Parts::all)
      if (auto fault = find_interfaces(result_, result_)) problems_.push_back(*std::move(fault));
    if (cancelled_ || !problems_.empty()) return tl::unexpected(std::move(problems_));
    return std::move(result_);
  }

 private:
  void observer() {
    auto loaded = load_observer(scene_.settings(), "settings", assets_);
    if (loaded)
      result_.observer = *std::move(loaded);
    else
      problems_.push_back(std::move(loaded.error()));
  }

  using SpectrumIndex = std::map<std::string, std::uint32_t>;

  void light(int index) {
    const v1::Light& light = scene_.light(index);
    const std::string field = "light[" + std::to_string(index) + "]";
    if (light.has_environment()) return environment(light, field);
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
         .emission = spectrum(light.spectrum(), field + ".spectrum", SpectrumRole::emission),
         .visible = !light.has_visible() || light.visible()});
  }

  void environment(const v1::Light& light, const std::string& field) {
    const std::uint32_t emission =
        spectrum(light.spectrum(), field + ".spectrum", SpectrumRole::emission);
    auto added = add_environment(light, field, emission, assets_, result_);
    if (!added) problems_.push_back(std::move(added.error()));
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
         .constants = exact ? constants(material.fresnel(), field + ".fresnel") : 0,
         .diffuse = property(material.has_diffuse(), material.diffuse(), 0, field + ".diffuse"),
         .specular = property(material.has_specular(), material.specular(), 1, field + ".specular"),
         .mirror = static_cast<float>(material.mirror())});
    mesh_needs_.tangents |= result_.materials.back().anisotropic();
    mesh_needs_.uvs |= material.has_texture();
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
    auto picture = textures_(texture, field);
    if (!picture) return problems_.push_back(std::move(picture.error()));
    if (result_.materials.size() + picture->channels > limits::max_materials)
      return add(field + ".spectrum", "materials and spectra of textures are at most " +
                                          std::to_string(limits::max_materials) + " together");

    note(picture->notes, field + ".file");
    const bool rgb = texture.use() == v1::Texture::RGB;
    RenderTexture to{*std::move(picture), texture.wrap(), uv_map(texture), {}, !rgb};
    for (int i = 0; i < texture.spectrum_size(); ++i) {
      const std::string spectrum_field = field + ".spectrum[" + std::to_string(i) + "]";
      const std::string name = material.name() + "#" + std::to_string(i + 1);
      if (is_material(name))
        add(spectrum_field, "the scene has a material " + quoted(name) +
                                ", as this spectrum is called for relighting");
      to.materials.push_back(
          add_matte(name, spectrum(texture.spectrum(i), spectrum_field, SpectrumRole::property)));
    }
    for (std::size_t i = 0; rgb && i < 3; ++i)
      to.materials.push_back(
          add_matte(material.name() + "#" + "RGB"[i], primary_reflectance(i, field)));
    result_.materials[static_cast<std::size_t>(index)].texture =
        static_cast<std::uint32_t>(result_.textures.size());
    result_.textures.push_back(std::move(to));
  }

  /// A material that no object has.
  std::uint32_t add_matte(const std::string& name, std::uint32_t diffuse) {
    result_.materials.push_back({.name = name,
                                 .reflection = to_f32(reflection_of(v1::Material())),
                                 .fresnel = FresnelKind::none,
                                 .constants = 0,
                                 .diffuse = diffuse,
                                 .specular = property(false, {}, 1, ""),
                                 .mirror = 0});
    return static_cast<std::uint32_t>(result_.materials.size() - 1);
  }

  /// Of R, G or B alone (reflectance_of_rgb), which textures of colours share.
  std::uint32_t primary_reflectance(std::size_t channel, const std::string& field) {
    const auto [place, is_new] = known_properties_.try_emplace(
        std::string("RGB") + "RGB"[channel], static_cast<std::uint32_t>(result_.properties.size()));
    if (is_new) {
      Rgb primary{};
      primary[channel] = 1;
      result_.properties.push_back(reflectance_of_rgb(primary));
      result_.property_fields.push_back(field);
    }
    return place->second;
  }

  bool is_material(const std::string& name) const {
    return std::any_of(scene_.material().begin(), scene_.material().end(),
                       [&](const v1::Material& material) { return material.name() == name; });
  }

  /// The index of optical constants, loaded the first time that they are named.
  std::uint32_t constants(const v1::Fresnel& fresnel, const std::string& field) {
    const auto [place, is_new] = known_constants_.try_emplace(
        fresnel.SerializeAsString(), static_cast<std::uint32_t>(result_.constants.size()));
    if (is_new) {
      auto loaded = load_fresnel(fresnel, field, assets_);
      if (!loaded) problems_.push_back(std::move(loaded.error()));
      result_.constants.push_back(loaded ? *std::move(loaded)
                                         : OpticalConstants{Spectrum{{550}, {1}}, {}});
      result_.constants_fields.push_back(field);
    }
    return place->second;
  }

  std::uint32_t property(bool given, const v1::Spectrum& message, double otherwise,
                         const std::string& field) {
    if (given) return spectrum(message, field, SpectrumRole::property);
    v1::Spectrum constant;
    constant.set_constant(otherwise);
    return spectrum(constant, field, SpectrumRole::property);
  }

  /// The index of a spectrum, loaded the first time that it is named.
  std::uint32_t spectrum(const v1::Spectrum& message, const std::string& field, SpectrumRole role) {
    const bool emission = role == SpectrumRole::emission;
    auto& known = emission ? known_emissions_ : known_properties_;
    auto& spectra = emission ? result_.emissions : result_.properties;
    auto& fields = emission ? result_.emission_fields : result_.property_fields;
    const auto [place, is_new] =
        known.try_emplace(message.SerializeAsString(), static_cast<std::uint32_t>(spectra.size()));
    if (is_new) {
      auto loaded = load_noted_spectrum(message, field, role, assets_);
      if (!loaded) problems_.push_back(std::move(loaded.error()));
      if (loaded) note(loaded->notes, field);
      Spectrum own = loaded ? std::move(loaded->spectrum) : Spectrum{{550}, {0}};
      spectra.push_back(emission ? as_emission(std::move(own)) : std::move(own));
      fields.push_back(field);
    }
    return place->second;
  }

  void note(const std::vector<std::string>& notes, const std::string& field) {
    for (const std::string& message : notes) result_.notices.push_back({field, message});
  }

  void object(int index) {
    const v1::Object& object = scene_.object(index);
    RenderObject to{
        .name = object.name(),
        .shape = RenderObject::Shape::mesh,
        .mesh = 0,
        .material = material_named(object.material()),
        .shading = object.has_shading() ? object.shading() : scene_.settings().shading(),
        .to_world = placement(object.transform())};
    switch (object.shape_case()) {
      case v1::Object::kMesh:
        to.mesh = known_meshes_.at(mesh_key(object.mesh()));
        break;
      case v1::Object::kQuad:
        to.mesh = quad(object.quad());
        to.to_world.translate(to_vector(object.quad().corner()));
        break;
      case v1::Object::kSphere:
        to.shape = RenderObject::Shape::sphere;
        to.to_world.translate(to_vector(object.sphere().center()));
        to.to_world.scale(object.sphere().radius());
        break;
      case v1::Object::kPlane:
        to.shape = RenderObject::Shape::plane;
        if (result_.materials[to.material].medium > 0)
          add("object[" + std::to_string(index) + "].plane",
              "a plane encloses nothing: its material can't be clear");
        to.to_world.translate(to_vector(object.plane().point()));
        if (object.plane().has_normal())
          to.to_world.rotate(Eigen::Quaterniond::FromTwoVectors(
              Eigen::Vector3d::UnitY(), unit(to_vector(object.plane().normal()))));
        break;
      case v1::Object::SHAPE_NOT_SET:
        return;
    }
    check_place(to, "object[" + std::to_string(index) + "]");
    if (to.shape == RenderObject::Shape::mesh && result_.materials[to.material].texture &&
        result_.meshes[to.mesh].uvs.empty())
      add("object[" + std::to_string(index) + "]",
          "its mesh has no UVs, which the texture of " + quoted(object.material()) + " needs");
    result_.objects.push_back(std::move(to));
  }

  /// Mesh and transform are each within bounds; what they make together has to be, too.
  void check_place(const RenderObject& object, const std::string& field) {
    Eigen::AlignedBox3d box(Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(1));
    if (object.shape == RenderObject::Shape::mesh) box = bounds(object.mesh);
    if (object.shape == RenderObject::Shape::plane)
      box = Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0));
    if (box.isEmpty()) return;
    const Eigen::AlignedBox3d placed = box.transformed(object.to_world);
    const double reach =
        std::max(placed.min().cwiseAbs().maxCoeff(), placed.max().cwiseAbs().maxCoeff());
    if (!(reach <= limits::max_coordinate))
      add(field, "reaches " + shown(reach) + " from the origin; at most " +
                     shown(limits::max_coordinate) + " is allowed");
    else if (object.shape == RenderObject::Shape::sphere)
      check_axes(object.to_world.linear(), field);
  }

  /// An ellipsoid is traced in a space of its own, where rays have to stay within bounds, too.
  void check_axes(const Eigen::Matrix3d& axes, const std::string& field) {
    const Eigen::Matrix3d near_one = scaled_by_two_to(-exponent_of(axes), axes);
    const double ratio = near_one.determinant() != 0 ? near_one.norm() * near_one.inverse().norm()
                                                     : std::numeric_limits<double>::infinity();
    if (!(ratio <= max_axis_ratio))
      add(field, "its axes differ by a factor of " + shown(ratio) + "; at most " +
                     shown(max_axis_ratio) + " is allowed");
  }

  /// The box around a mesh in its own space, computed the first time that it is asked for.
  const Eigen::AlignedBox3d& bounds(std::uint32_t mesh) {
    while (mesh_bounds_.size() <= mesh) {
      Eigen::AlignedBox3d& box = mesh_bounds_.emplace_back();
      box = box_of(result_.meshes[mesh_bounds_.size() - 1].positions);
    }
    return mesh_bounds_[mesh];
  }

  void import_files() {
    for (const MeshRequest& request : mesh_requests(scene_, mesh_needs_)) {
      if (cancelled_) return;
      take_meshes(import_(request), request);
    }
  }

  void take_meshes(Result<std::vector<TriangleMesh>> imported, const MeshRequest& request) {
    if (!imported) {
      problems_.push_back(std::move(imported.error()));
      imported.emplace(request.meshes.size());  // Objects are checked all the same.
    }
    for (std::size_t i = 0; i < request.meshes.size(); ++i) {
      known_meshes_[request.meshes[i].key] = static_cast<std::uint32_t>(result_.meshes.size());
      note((*imported)[i].notes, request.meshes[i].field + ".file");
      result_.meshes.push_back(std::move((*imported)[i]));
    }
  }

  /// A quad is a mesh of its own around its corner, where f32 is finest.
  std::uint32_t quad(const v1::Quad& quad) {
    const Eigen::Vector3d u = to_vector(quad.u()), v = to_vector(quad.v());
    const auto f32 = [](const Eigen::Vector3d& p) {
      return Float3{static_cast<float>(p.x()), static_cast<float>(p.y()),
                    static_cast<float>(p.z())};
    };
    TriangleMesh mesh;
    mesh.positions = Array<Float3>(std::vector<Float3>{{}, f32(u), f32(u + v), f32(v)});
    mesh.triangles = std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}};
    if (mesh_needs_.tangents) mesh.tangents = std::vector<Float3>(4, f32(unit(u)));
    if (mesh_needs_.uvs) mesh.uvs = std::vector<Float2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    result_.meshes.push_back(std::move(mesh));
    return static_cast<std::uint32_t>(result_.meshes.size() - 1);
  }

  std::uint32_t material_named(const std::string& name) {
    if (known_materials_.empty())
      for (int i = 0; i < scene_.material_size(); ++i)
        known_materials_[scene_.material(i).name()] = static_cast<std::uint32_t>(i);
    return known_materials_.at(name);  // validate_scene has seen to it
  }

  void add(std::string field, std::string message) {
    problems_.push_back({.field = std::move(field), .file = {}, .message = std::move(message)});
  }

  const v1::Scene& scene_;
  const AssetReader& assets_;
  const MeshImport& import_;
  const TextureImport& textures_;
  const std::atomic<bool>& cancelled_;
  RenderScene result_;
  std::vector<Problem> problems_;
  SpectrumIndex known_emissions_, known_properties_, known_constants_;
  MeshNeeds mesh_needs_;
  std::map<std::string, std::uint32_t> known_meshes_;  ///< By mesh_key().
  std::map<std::string, std::uint32_t> known_materials_;
  std::vector<Eigen::AlignedBox3d> mesh_bounds_;
};

}  // namespace

tl::expected<RenderScene, std::vector<Problem>> compile_scene(const v1::Scene& scene,
                                                              const AssetReader& assets,
                                                              const MeshImport& meshes,
                                                              const TextureImport& textures,
                                                              const std::atomic<bool>& cancelled) {
  return Compiler(scene, assets, meshes, textures, cancelled).run(Compiler::Parts::all);
}

tl::expected<RenderScene, std::vector<Problem>> compile_appearance(const v1::Scene& scene,
                                                                   const AssetReader& assets,
                                                                   const TextureImport& textures) {
  const std::atomic<bool> never = false;
  return Compiler(scene, assets, MeshImport(), textures, never).run(Compiler::Parts::appearance);
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
  return to;
}

}  // namespace metamer
