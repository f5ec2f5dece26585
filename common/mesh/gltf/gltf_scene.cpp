#include "common/mesh/gltf/gltf_scene.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <set>

#include "common/mesh/gltf/nodes.h"
#include "common/mesh/gltf/pictures.h"
#include "common/mesh/text.h"

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
    scene.left_out.push_back("the orthographic camera " +
                             mesh_text::cited(name_of_node(document, node.index)));
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

/// The extensions that a file says it uses, each once; there are fewer in the world.
std::set<std::string> extensions_of(const Document& document) {
  constexpr std::size_t most = 256;
  const Value used = document.root()["extensionsUsed"];
  std::set<std::string> names;
  for (std::size_t i = 0; i < std::min(used.size(), most); ++i)
    names.insert(on_one_line(used[i].text()));
  return names;
}

/// What a material has beside its base colour (3.9, and its extensions).
std::vector<std::string> left_out_of(const Value& material, const std::set<std::string>& extensions,
                                     bool has_normals) {
  std::vector<std::string> names;
  const auto tell = [&](bool counts, const std::string& name) {
    if (counts) names.push_back(name);
  };
  const Value rough = material["pbrMetallicRoughness"];
  tell(rough["roughnessFactor"].number(1) != 1, "roughnessFactor");
  tell(bool(rough["metallicRoughnessTexture"]), "metallicRoughnessTexture");
  tell(material["normalTexture"] && !has_normals, "normalTexture");
  for (const char* texture : {"occlusionTexture", "emissiveTexture"})
    tell(bool(material[texture]), texture);
  if (const auto emitted = material["emissiveFactor"].numbers(3))
    tell(*emitted != std::vector<double>(3, 0.0), "emissiveFactor");
  for (const std::string& extension : extensions)
    tell(bool(material["extensions"][extension.c_str()]), extension);
  return names;
}

void read_materials(Document& document, GltfScene& scene) {
  Pictures pictures(document, scene.images);
  const Value materials = document.root()["materials"];
  const std::vector<std::string> names = material_names(document);
  const std::set<std::string> extensions = extensions_of(document);
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const Value rough = materials[i]["pbrMetallicRoughness"];
    const auto normals = pictures.of(materials[i]["normalTexture"]);
    GltfMaterial material{.name = names[i],
                          .base_color = {1, 1, 1},
                          .is_textured = bool(rough["baseColorTexture"]),
                          .is_metallic = rough["metallicFactor"].number(1) > 0.5,
                          .base_color_picture = pictures.of(rough["baseColorTexture"]),
                          .normal_picture = normals,
                          .alpha_mode = on_one_line(materials[i]["alphaMode"].text()),
                          .alpha_cutoff = materials[i]["alphaCutoff"].number(0.5),
                          .left_out = left_out_of(materials[i], extensions, normals.has_value())};
    if (const auto color = rough["baseColorFactor"].numbers(4)) {
      for (std::size_t k = 0; k < 3; ++k)
        material.base_color[k] = std::clamp((*color)[k], 0.0, 1.0);
      material.base_alpha = std::clamp((*color)[3], 0.0, 1.0);
    }
    scene.materials.push_back(std::move(material));
  }
}

/// Extensions that are neither done nor a material's or a texture's, which are told with these.
void tell_extensions(const Document& document, GltfScene& scene) {
  static constexpr std::array done = {"KHR_mesh_quantization", "EXT_mesh_gpu_instancing",
                                      "KHR_lights_punctual", "KHR_xmp_json_ld"};
  for (const std::string& name : extensions_of(document)) {
    const bool is_told =
        name.find("_texture_") != std::string::npos ||
        std::any_of(scene.materials.begin(), scene.materials.end(), [&](const GltfMaterial& one) {
          return std::count(one.left_out.begin(), one.left_out.end(), name) > 0;
        });
    if (!is_told && std::find(done.begin(), done.end(), name) == done.end())
      scene.left_out.push_back("the extension " + mesh_text::cited(name));
  }
}

/// Points and lines of a node's mesh, each kind and material once.
void tell_points_and_lines(const Document& document, const PlacedNode& node, std::size_t mesh,
                           const std::vector<std::string>& materials, GltfScene& scene) {
  const Value primitives = document.root()["meshes"][mesh]["primitives"];
  std::set<std::string> told;
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const std::uint64_t mode = primitives[i]["mode"].whole(6, 4);
    if (mode >= 4) continue;
    std::string text = (mode == 0 ? "points of " : "lines of ") +
                       mesh_text::cited(name_of_node(document, node.index));
    if (const auto at = primitives[i]["material"].index(materials.size()))
      text += ", whose material is " + mesh_text::cited(materials[*at]);
    if (told.insert(text).second) scene.left_out.push_back(text);
  }
}

}  // namespace

static Result<GltfScene> read_scene(Document& document) {
  GltfScene scene;
  const Value root = document.root(), nodes = root["nodes"];
  const Value lights = root["extensions"]["KHR_lights_punctual"]["lights"];
  const std::vector<std::string> materials = material_names(document);
  std::set<std::size_t> meshes;
  for (const PlacedNode& node : placed_nodes(document)) {
    const Value value = nodes[node.index];
    const auto mesh = value["mesh"].index(root["meshes"].size());
    if (mesh && meshes.insert(*mesh).second)
      tell_points_and_lines(document, node, *mesh, materials, scene);
    if (const auto at = value["camera"].index(root["cameras"].size()))
      if (auto camera = camera_of(document, node, *at, scene)) scene.cameras.push_back(*camera);
    if (const auto at = value["extensions"]["KHR_lights_punctual"]["light"].index(lights.size()))
      if (auto light = light_of(document, node, lights[*at])) scene.lights.push_back(*light);
  }
  read_materials(document, scene);
  tell_extensions(document, scene);
  if (root["scenes"].size() > 1)
    scene.left_out.push_back("all scenes but the one that the file shows first");
  if (document.fault()) return problem("is not sound glTF: " + *document.fault());
  return scene;
}

}  // namespace metamer::gltf

namespace metamer {

Result<GltfScene> read_gltf_scene(const Bytes& bytes, const std::string& name,
                                  const MeshBytes& files) {
  auto document = gltf::Document::open(bytes, name, files);
  if (!document) return tl::unexpected(document.error());
  return gltf::read_scene(*document);
}

}  // namespace metamer
