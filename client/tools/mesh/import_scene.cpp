#include "client/tools/mesh/import_scene.h"

#include <google/protobuf/text_format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <set>

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

/// sRGB as people write it: "#C02020".
std::string hex_of(const Double3& linear) {
  const auto byte = [](double x) {
    const double encoded = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
    return static_cast<unsigned>(std::lround(255 * std::clamp(encoded, 0.0, 1.0)));
  };
  char text[8];
  std::snprintf(text, sizeof text, "#%02X%02X%02X", byte(linear[0]), byte(linear[1]),
                byte(linear[2]));
  return text;
}

/// Y of linear sRGB (IEC 61966-2-1).
double luminance_of(const Double3& linear) {
  return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2];
}

/// Builds one scene.
class Builder {
 public:
  Builder(const MeshFacts& facts, std::string file, const GltfScene& gltf)
      : facts_(facts), file_(std::move(file)), gltf_(gltf) {
    const Vector3d low = vector_of(facts.low), high = vector_of(facts.high);
    center_ = (low + high) / 2;
    radius_ = std::max((high - low).norm() / 2, 1e-9);
  }

  ImportedScene build() {
    result_.left_out = gltf_.left_out;
    for (const std::string& note : facts_.notes) result_.left_out.push_back(note);
    camera();
    lights();
    objects();
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
    if (light.kind == GltfLight::Kind::directional) return light.intensity;
    const double away = std::max((vector_of(light.position) - center_).norm(), 1e-6 * radius_);
    return light.intensity / (away * away);
  }

  void lights() {
    double brightest = 0;
    for (const GltfLight& light : gltf_.lights) brightest = std::max(brightest, illuminance(light));
    if (!(brightest > 0)) return lamp();
    UniqueNames names;
    bool colored = false;
    for (const GltfLight& from : gltf_.lights) {
      const double luminance = illuminance(from) / brightest;
      if (!(luminance >= limits::min_luminance)) continue;
      v1::Light& to = *result_.message.add_light();
      to.set_name(names(from.name, "light"));
      to.mutable_spectrum()->set_standard("D65");
      to.set_luminance(luminance);
      place(from, to);
      colored = colored || from.is_colored;
    }
    result_.left_out.push_back(
        "candela and lux: a light's luminance is relative to the brightest in the middle of the "
        "scene; all shine as D65" +
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
      parts = {{.object = parts.front().object, .material = parts.front().material, .part = {}}};
    }
    UniqueNames names;
    std::set<std::string> materials;
    for (const MeshPart& part : parts) {
      const std::string material = part.material.empty() ? "material" : part.material;
      v1::Object& object = *result_.message.add_object();
      object.set_name(names(part.object.empty() ? part.material : part.object, "object"));
      object.set_material(material);
      object.mutable_mesh()->set_file(file_);
      if (!part.part.empty()) object.mutable_mesh()->set_part(part.part);
      if (materials.insert(material).second) add_material(material);
    }
  }

  void add_material(const std::string& name) {
    v1::Material& to = *result_.message.add_material();
    to.set_name(name);
    const auto from = std::find_if(gltf_.materials.begin(), gltf_.materials.end(),
                                   [&](const GltfMaterial& one) { return one.name == name; });
    if (from == gltf_.materials.end()) {
      to.mutable_diffuse()->set_constant(no_color);
      return;
    }
    to.mutable_diffuse()->set_constant(luminance_of(from->base_color));
    std::string what = "material \"" + name + "\": its base colour is " + hex_of(from->base_color);
    if (from->is_textured) what += ", times a texture";
    if (from->is_metallic) what += ", and it is a metal";
    result_.left_out.push_back(what + "; a neutral of its luminance stands for it");
  }

  const MeshFacts& facts_;
  std::string file_;
  const GltfScene& gltf_;
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
  const MeshFacts facts = mesh_facts(*loaded, mesh);
  if (facts.format == "glTF") {
    auto scene = load_gltf_scene(mesh);
    if (!scene) return tl::unexpected(scene.error());
    gltf = *std::move(scene);
  } else if (facts.format == "OBJ") {
    gltf.left_out.push_back("the colours of a .mtl: materials are neutral");
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
  return Builder(facts, relative, gltf).build();
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
  printer.PrintToString(scene.message, &body);
  return text + "\n" + body;
}

}  // namespace metamer::client
