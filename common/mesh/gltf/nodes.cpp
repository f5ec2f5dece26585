#include "common/mesh/gltf/nodes.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace metamer::gltf {
namespace {

Placement local_transform(const Value& node) {
  if (const auto m = node["matrix"].numbers(16)) {  // By columns.
    Placement map;
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 3; ++row)
        map.linear(row, column) = (*m)[static_cast<std::size_t>(4 * column + row)];
    map.translation = {(*m)[12], (*m)[13], (*m)[14]};
    if ((*m)[3] != 0 || (*m)[7] != 0 || (*m)[11] != 0 || (*m)[15] != 1)
      node["matrix"].fault("is not affine");
    return map;
  }
  const auto t = node["translation"].numbers(3), r = node["rotation"].numbers(4),
             s = node["scale"].numbers(3);
  return transform(
      t ? Eigen::Vector3d(t->data()) : Eigen::Vector3d::Zero(),
      r ? std::array{(*r)[0], (*r)[1], (*r)[2], (*r)[3]} : std::array{0.0, 0.0, 0.0, 1.0},
      s ? Eigen::Vector3d(s->data()) : Eigen::Vector3d::Ones());
}

/// Where the walk begins.
std::vector<std::size_t> roots(const Document& document, std::size_t count) {
  const Value root = document.root(), scenes = root["scenes"];
  std::vector<std::size_t> list;
  if (scenes.size() > 0) {
    const Value scene = root["scene"];
    const Value nodes = scenes[scene ? scene.index(scenes.size()).value_or(0) : 0]["nodes"];
    for (std::size_t i = 0; i < nodes.size(); ++i)
      if (const auto at = nodes[i].index(count)) list.push_back(*at);
    return list;
  }
  std::vector<bool> is_child(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Value children = root["nodes"][i]["children"];
    for (std::size_t c = 0; c < children.size(); ++c)
      if (const auto at = children[c].index(count)) is_child[*at] = true;
  }
  for (std::size_t i = 0; i < count; ++i)
    if (!is_child[i]) list.push_back(i);
  return list;
}

}  // namespace

Placement transform(const Eigen::Vector3d& translation, const std::array<double, 4>& rotation,
                    const Eigen::Vector3d& scale) {
  Placement map;
  map.translation = translation;
  const double length =
      std::hypot(std::hypot(rotation[0], rotation[1]), std::hypot(rotation[2], rotation[3]));
  if (length > 0) {
    const double x = rotation[0] / length, y = rotation[1] / length, z = rotation[2] / length,
                 w = rotation[3] / length;
    map.linear << 1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w),  //
        2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),            //
        2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y);
  }
  for (int column = 0; column < 3; ++column) map.linear.col(column) *= scale[column];
  return map;
}

std::vector<PlacedNode> placed_nodes(const Document& document) {
  const Value nodes = document.root()["nodes"];
  const std::size_t count = nodes.size();
  std::vector<PlacedNode> placed;
  std::vector<bool> met(count);
  std::vector<PlacedNode> next;
  const auto begin = roots(document, count);
  for (auto root = begin.rbegin(); root != begin.rend(); ++root)
    next.push_back({*root, Placement()});
  while (!next.empty() && !document.fault()) {
    PlacedNode node = next.back();
    next.pop_back();
    if (met[node.index]) {
      nodes[node.index].fault("is met twice on the way through the scene");
      break;
    }
    met[node.index] = true;
    node.to_world = node.to_world * local_transform(nodes[node.index]);
    const Value children = nodes[node.index]["children"];
    for (std::size_t i = children.size(); i-- > 0;)
      if (const auto child = children[i].index(count)) next.push_back({*child, node.to_world});
    placed.push_back(node);
  }
  return placed;
}

std::string on_one_line(std::string name) {
  std::replace_if(
      name.begin(), name.end(),
      [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == '\x7F'; }, '_');
  return name;
}

std::string name_of_node(const Document& document, std::size_t index) {
  const Value root = document.root(), node = root["nodes"][index];
  std::string name = node["name"].text();
  if (name.empty())
    if (const auto mesh = node["mesh"].index(root["meshes"].size()))
      name = root["meshes"][*mesh]["name"].text();
  return name.empty() ? "node_" + std::to_string(index) : on_one_line(std::move(name));
}

std::vector<std::string> material_names(const Document& document) {
  const Value materials = document.root()["materials"];
  std::vector<std::string> names;
  std::set<std::string> given;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    const std::string own = on_one_line(materials[i]["name"].text());
    const std::string name = own.empty() ? "material_" + std::to_string(i) : own;
    std::string one = name;
    for (int k = 2; !given.insert(one).second; ++k) one = name + " " + std::to_string(k);
    names.push_back(one);
  }
  return names;
}

}  // namespace metamer::gltf
