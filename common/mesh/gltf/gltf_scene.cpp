#include "common/mesh/gltf/gltf_scene.h"

#include <algorithm>
#include <numbers>

#include "common/mesh/gltf/nodes.h"

namespace metamer::gltf {
namespace {

constexpr double degrees = 180 / std::numbers::pi;

Double3 to_list(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Double3 unit(const Eigen::Vector3d& v) { return to_list(v.norm() > 0 ? v.normalized() : v); }

/// A camera looks along −z of its node (3.10).
std::optional<GltfCamera> camera_of(const Document& document, const PlacedNode& node,
                                    std::size_t index, GltfScene& scene) {
  const Value camera = document.root()["cameras"][index], view = camera["perspective"];
  if (!view) {
    scene.left_out.push_back("an orthographic camera");
    return std::nullopt;
  }
  const double fov = view["yfov"].number(0) * degrees;
  if (!(fov > 0 && fov < 180)) view["yfov"].fault("must lie between 0 and π");
  const Eigen::Matrix3d& axes = node.to_world.linear;
  return GltfCamera{.name = name_of_node(document, node.index),
                    .eye = to_list(node.to_world.translation),
                    .forward = unit(-axes.col(2)),
                    .up = unit(axes.col(1)),
                    .vertical_fov = fov};
}

std::optional<GltfLight> light_of(const Document& document, const PlacedNode& node,
                                  const Value& light) {
  GltfLight to{.name = on_one_line(light["name"].text()),
               .kind = GltfLight::Kind::point,
               .position = to_list(node.to_world.translation),
               .direction = unit(-node.to_world.linear.col(2)),
               .intensity = light["intensity"].number(1),
               .inner_cone = light["spot"]["innerConeAngle"].number(0) * degrees,
               .outer_cone = light["spot"]["outerConeAngle"].number(std::numbers::pi / 4) * degrees,
               .is_colored = false};
  if (to.name.empty()) to.name = name_of_node(document, node.index);
  if (const auto color = light["color"].numbers(3))
    to.is_colored = (*color)[0] != (*color)[1] || (*color)[1] != (*color)[2];
  const std::string type = light["type"].text();
  if (type == "directional") {
    to.kind = GltfLight::Kind::directional;
  } else if (type == "spot") {
    to.kind = GltfLight::Kind::spot;
  } else if (type != "point") {
    light["type"].fault("must be point, directional or spot");
    return std::nullopt;
  }
  return to;
}

void read_materials(const Document& document, GltfScene& scene) {
  const Value materials = document.root()["materials"];
  const std::vector<std::string> names = material_names(document);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const Value rough = materials[i]["pbrMetallicRoughness"];
    GltfMaterial material{.name = names[i],
                          .base_color = {1, 1, 1},
                          .is_textured = bool(rough["baseColorTexture"]),
                          .is_metallic = rough["metallicFactor"].number(1) > 0.5};
    if (const auto color = rough["baseColorFactor"].numbers(4))
      for (std::size_t k = 0; k < 3; ++k)
        material.base_color[k] = std::clamp((*color)[k], 0.0, 1.0);
    scene.materials.push_back(std::move(material));
  }
}

void tell_what_is_left(const Document& document, GltfScene& scene) {
  const auto count = [&](const char* list, const char* one, const char* many) {
    if (const std::size_t n = document.root()[list].size(); n > 0)
      scene.left_out.push_back(std::to_string(n) + " " + (n == 1 ? one : many));
  };
  count("textures", "texture", "textures");
  count("animations", "animation", "animations");
  count("skins", "skin", "skins");
}

}  // namespace

static Result<GltfScene> read_scene(const Document& document) {
  GltfScene scene;
  const Value root = document.root(), nodes = root["nodes"];
  const Value lights = root["extensions"]["KHR_lights_punctual"]["lights"];
  for (const PlacedNode& node : placed_nodes(document)) {
    const Value value = nodes[node.index];
    if (const auto at = value["camera"].index(root["cameras"].size()))
      if (auto camera = camera_of(document, node, *at, scene)) scene.cameras.push_back(*camera);
    if (const auto at = value["extensions"]["KHR_lights_punctual"]["light"].index(lights.size()))
      if (auto light = light_of(document, node, lights[*at])) scene.lights.push_back(*light);
  }
  read_materials(document, scene);
  tell_what_is_left(document, scene);
  if (document.fault()) return problem("is not sound glTF: " + *document.fault());
  return scene;
}

}  // namespace metamer::gltf

namespace metamer {

Result<GltfScene> read_gltf_scene(const Bytes& bytes, const std::string& name,
                                  const MeshBytes& files) {
  const auto document = gltf::Document::open(bytes, name, files);
  if (!document) return tl::unexpected(document.error());
  return gltf::read_scene(*document);
}

}  // namespace metamer
