#include "client/tools/mesh/import_scene.h"

#include <google/protobuf/text_format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "client/tools/mesh/import_materials.h"
#include "client/tools/mesh/top_illuminance.h"
#include "common/mesh/gltf/gltf_scene.h"
#include "common/scene/limits.h"

namespace metamer::client {
namespace {

using Eigen::Vector3d;
constexpr double view_angle = 35;  ///< Degrees, of the camera that a file without one gets.
constexpr double no_color = 0.5;   ///< The neutral of a material without a base colour.

Vector3d vector_of(const Double3& v) { return {v[0], v[1], v[2]}; }
void set(const Vector3d& from, v1::Vec3& to) {
  to.set_x(from.x());
  to.set_y(from.y());
  to.set_z(from.z());
}

/// Names that are each given once, fit for a scene: "seat", "seat 2".
class UniqueNames {
 public:
  std::string operator()(std::string name, const std::string& otherwise) {
    if (name.empty()) name = otherwise;
    name.resize(std::min<std::size_t>(name.size(), limits::max_name - 20));
    while (!name.empty() && (name.back() & 0xC0) == 0x80) name.pop_back();
    std::string one = name;
    for (int i = 2; !given_.insert(one).second; ++i) one = name + " " + std::to_string(i);
    return one;
  }

 private:
  std::set<std::string> given_;
};

/// Builds one scene.
class Builder {
 public:
  Builder(const MeshFile& mesh, const MeshFacts& facts, std::string file, const GltfScene& gltf,
          const FileMaterials& materials, ImportedPictures& pictures)
      : mesh_(mesh),
        facts_(facts),
        file_(std::move(file)),
        gltf_(gltf),
        materials_(materials),
        pictures_(pictures) {
    const Vector3d low = vector_of(facts.low), high = vector_of(facts.high);
    center_ = (low + high) / 2;
    radius_ = std::max((high - low).norm() / 2, 1e-9);
  }

  ImportedScene build() {
    result_.left_out = gltf_.left_out;
    result_.left_out.insert(result_.left_out.end(), materials_.left_out.begin(),
                            materials_.left_out.end());
    for (const std::string& note : facts_.notes) result_.left_out.push_back(note);
    // Those of a glTF are its points and lines, which are named.
    if (facts_.skipped_faces > 0 && facts_.format != "glTF")
      result_.left_out.push_back(skipped_text(facts_));
    camera();
    lights();
    objects();
    result_.files = pictures_.take_files();
    return std::move(result_);
  }

 private:
  void camera() {
    v1::Camera& to = *result_.message.mutable_camera();
    if (gltf_.cameras.size() > 1)
      result_.left_out.push_back("all cameras but the first, \"" + gltf_.cameras[0].name + "\"");
    if (!gltf_.cameras.empty()) {
      const GltfCamera& from = gltf_.cameras.front();
      set(vector_of(from.eye), *to.mutable_eye());
      const double ahead = std::max((center_ - vector_of(from.eye)).norm(), radius_);
      set(vector_of(from.eye) + ahead * vector_of(from.forward), *to.mutable_target());
      set(vector_of(from.up), *to.mutable_up());
      to.set_vertical_fov(from.vertical_fov);
      return;
    }
    const double away = 1.1 * radius_ / std::sin(view_angle / 2 * std::numbers::pi / 180);
    set(center_ + away * Vector3d(0.5, 0.4, 1).normalized(), *to.mutable_eye());
    set(center_, *to.mutable_target());
    to.set_vertical_fov(view_angle);
    result_.left_out.push_back("no camera is in the file: one sees all of it");
  }

  /// Of a light in the middle of the scene, in lux.
  double illuminance(const GltfLight& light) const {
    return illuminance_at(light, {center_.x(), center_.y(), center_.z()}, 1e-6 * radius_);
  }

  void lights() {
    double brightest = 0;
    for (const GltfLight& light : gltf_.lights) brightest = std::max(brightest, illuminance(light));
    if (!(brightest > 0)) return lamp();
    const double top = top_illuminance(mesh_, gltf_.lights);
    const double unit = top > 0 ? top : brightest;
    UniqueNames names;
    bool colored = false;
    for (const GltfLight& from : gltf_.lights) {
      const double luminance = illuminance(from) / unit;
      if (!(luminance >= limits::min_luminance && luminance <= limits::max_luminance)) {
        result_.left_out.push_back("the light " + quoted(from.name) +
                                   ", which is too weak or too strong");
        continue;
      }
      v1::Light& to = *result_.message.add_light();
      to.set_name(names(from.name, "light"));
      to.mutable_spectrum()->set_standard("D65");
      to.set_luminance(luminance);
      place(from, to);
      colored = colored || from.is_colored;
    }
    if (result_.message.light_size() == 0) return lamp();
    result_.left_out.push_back(
        "candela and lux: the lights are scaled together, so that 99.9 % of all surfaces, were "
        "they "
        "white and without shadows, are within a picture's range; all shine as D65" +
        std::string(colored ? ", also the coloured ones" : ""));
  }

  void place(const GltfLight& from, v1::Light& to) const {
    const Vector3d position = vector_of(from.position), direction = vector_of(from.direction);
    if (from.kind == GltfLight::Kind::directional) return set(direction, *to.mutable_direction());
    to.set_reference_distance(std::max((position - center_).norm(), 1e-6 * radius_));
    if (from.kind == GltfLight::Kind::point) return set(position, *to.mutable_position());
    v1::Light::Spot& spot = *to.mutable_spot();
    set(position, *spot.mutable_position());
    set(direction, *spot.mutable_direction());
    const double outer = std::clamp(from.outer_cone, 0.1, 90.0);
    const double inner = std::clamp(from.inner_cone, 0.0, outer);
    const auto versine = [](double angle) { return 1 - std::cos(angle * std::numbers::pi / 180); };
    spot.set_half_angle(outer);
    spot.set_penumbra(std::clamp(1 - versine(inner) / versine(outer), 0.0, 1.0));
  }

  void lamp() {
    v1::Light& to = *result_.message.add_light();
    to.set_name("lamp");
    to.mutable_spectrum()->set_standard("D65");
    set(Vector3d(-0.5, -1, -0.7), *to.mutable_direction());
    result_.left_out.push_back("no light is in the file: a D65 shines from above");
  }

  void objects() {
    // Parts that no name tells from others are taken together with all others.
    const bool named = std::all_of(facts_.parts.begin(), facts_.parts.end(),
                                   [](const MeshPart& part) { return !part.part.empty(); });
    std::vector<MeshPart> parts = facts_.parts;
    if (!named && parts.size() > 1) {
      result_.left_out.push_back("parts that no name tells apart: the file is one object");
      const bool have_uvs =
          std::all_of(parts.begin(), parts.end(), [](const MeshPart& one) { return one.has_uvs; });
      parts = {{.object = parts.front().object,
                .material = parts.front().material,
                .part = {},
                .has_uvs = have_uvs}};
    }
    UniqueNames names;
    std::map<std::string, bool> have_uvs;
    const auto material_of = [](const MeshPart& part) {
      return part.material.empty() ? "material" : part.material;
    };
    for (const MeshPart& part : parts)
      have_uvs.try_emplace(material_of(part), true).first->second &= part.has_uvs;
    std::set<std::string> materials;
    for (const MeshPart& part : parts) {
      const std::string material = material_of(part);
      v1::Object& object = *result_.message.add_object();
      object.set_name(names(part.object.empty() ? part.material : part.object, "object"));
      object.set_material(material);
      object.mutable_mesh()->set_file(file_);
      if (!part.part.empty()) object.mutable_mesh()->set_part(part.part);
      if (materials.insert(material).second) add_material(material, have_uvs[material]);
    }
  }

  void add_material(const std::string& name, bool has_uvs) {
    v1::Material& to = *result_.message.add_material();
    to.set_name(name);
    const auto from = std::find_if(materials_.materials.begin(), materials_.materials.end(),
                                   [&](const FileMaterial& one) { return one.name == name; });
    if (from != materials_.materials.end()) {
      result_.left_out.push_back(fill(*from, has_uvs, pictures_, to));
      return;
    }
    to.mutable_diffuse()->set_constant(no_color);
    result_.left_out.push_back("material " + quoted(name) +
                               ": no base colour of it is in the file; a neutral stands for it");
  }

  const MeshFile& mesh_;
  const MeshFacts& facts_;
  std::string file_;
  const GltfScene& gltf_;
  const FileMaterials& materials_;
  ImportedPictures& pictures_;
  Vector3d center_;
  double radius_;
  ImportedScene result_;
};

}  // namespace

Result<ImportedScene> import_scene(const std::filesystem::path& mesh,
                                   const std::filesystem::path& scene_folder) {
  const auto loaded = load_mesh(mesh);
  if (!loaded) return tl::unexpected(loaded.error());
  GltfScene gltf;
  FileMaterials materials;
  const MeshFacts facts = mesh_facts(*loaded, mesh);
  if (facts.format == "glTF") {
    auto scene = load_gltf_scene(mesh);
    if (!scene) return tl::unexpected(scene.error());
    gltf = *std::move(scene);
    if (gltf.lights.size() > limits::max_lights) {
      gltf.lights.erase(gltf.lights.begin() + limits::max_lights, gltf.lights.end());
      gltf.left_out.push_back("all lights but the first " + std::to_string(limits::max_lights));
    }
    materials = materials_of(gltf);
  } else if (facts.format == "OBJ") {
    materials = load_obj_materials(mesh);
  }
  std::error_code error;
  const auto absolute = std::filesystem::weakly_canonical(mesh, error);
  const auto folder = std::filesystem::weakly_canonical(
      scene_folder.empty() ? std::filesystem::path(".") : scene_folder, error);
  const std::string relative = absolute.lexically_relative(folder).generic_string();
  if (relative.empty() || relative.starts_with(".."))
    return tl::unexpected(Problem{.field = {},
                                  .file = mesh.string(),
                                  .message = "lies outside the scene's folder, " +
                                             quoted(folder.string()) +
                                             ": put the scene into the mesh's folder or above it"});
  ImportedPictures pictures(gltf, relative, scene_folder);
  return Builder(*loaded, facts, relative, gltf, materials, pictures).build();
}

std::string scene_text(const ImportedScene& scene, const std::filesystem::path& mesh) {
  std::string text =
      "# proto-file: metamer/v1/scene.proto\n# proto-message: metamer.v1.Scene\n#\n"
      "# Made of " +
      mesh.filename().string() + " by `metamer import`. Left out, or put in its place:\n";
  for (const std::string& sentence : scene.left_out) text += "# - " + sentence + "\n";
  std::string body;
  google::protobuf::TextFormat::Printer printer;
  printer.SetUseUtf8StringEscaping(true);
  printer.SetUseShortRepeatedPrimitives(true);
  printer.PrintToString(scene.message, &body);
  return text + "\n" + body;
}

}  // namespace metamer::client
