#include "common/mesh/gltf/gltf_mesh.h"

#include <algorithm>
#include <limits>
#include <map>

#include "common/mesh/gltf/nodes.h"
#include "common/mesh/gltf/primitive.h"
#include "common/mesh/smooth_normals.h"
#include "common/mesh/text.h"
#include "common/mesh/vertex.h"
#include "common/scene/limits.h"

namespace metamer::gltf {
namespace {

/// Degrees: where a file has no normals, the edges that are kept. The format has all triangles
/// flat; a ball whose exporter left its normals out is meant to be round all the same.
constexpr double crease_angle = 30;

/// Where f32 would lose more than a millionth of what a scene spans: see needs_f64().
constexpr double far_times_its_size = 16;

struct OpenMesh {
  std::vector<Primitive> primitives;
  std::vector<double> weights;
  bool has_colors;  ///< Of vertices.
};

/// A mesh of the scene, as many times as its node has instances.
struct Draw {
  std::size_t node;
  std::size_t mesh;
  Drawn drawn;
};

std::vector<double> weights_of(const Value& list) {
  std::vector<double> weights;
  for (std::size_t i = 0; i < list.size(); ++i) weights.push_back(list[i].number(0));
  return weights;
}

/// EXT_mesh_gpu_instancing: a transform for each instance, before the node's own.
std::vector<Placement> instances_of(Document& document, const Value& node) {
  const Value attributes = node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"];
  if (!attributes) return {Placement()};
  const auto t = Accessor::open(document, attributes["TRANSLATION"], {"VEC3"}),
             r = Accessor::open(document, attributes["ROTATION"], {"VEC4"}),
             s = Accessor::open(document, attributes["SCALE"], {"VEC3"});
  std::size_t count = 0;
  for (const auto* list : {&t, &r, &s})
    if (*list) {
      if (count != 0 && (*list)->size() != count)
        attributes.fault("have not as many elements each");
      count = std::max(count, (*list)->size());
    }
  if (document.fault()) return {};
  const auto vector = [](const std::optional<Accessor>& list, std::size_t i, double otherwise) {
    Eigen::Vector3d v = Eigen::Vector3d::Constant(otherwise);
    if (list) v = {list->number(i, 0), list->number(i, 1), list->number(i, 2)};
    return v;
  };
  std::vector<Placement> maps;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<double, 4> turn = {0, 0, 0, 1};
    for (std::size_t c = 0; r && c < 4; ++c) turn[c] = r->number(i, c);
    maps.push_back(transform(vector(t, i, 0), turn, vector(s, i, 1)));
  }
  return maps;
}

bool has_colors(const Value& primitives) {
  for (std::size_t i = 0; i < primitives.size(); ++i)
    if (primitives[i]["attributes"]["COLOR_0"]) return true;
  return false;
}

/// Names in quotes, the first few of many.
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 5;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i)
    text += (i > 0 ? ", " : "") + mesh_text::cited(names[i]);
  if (names.size() > most) text += " and " + std::to_string(names.size() - most) + " more";
  return text;
}

/// Appends what has as fine positions, and normals.
void join(MeshFile from, MeshFile& to) {
  const auto base = static_cast<std::uint32_t>(vertex_count(to));
  const auto append_all = [](const auto& list, auto& all) {
    all.insert(all.end(), list.begin(), list.end());
  };
  append_all(from.positions, to.positions);
  append_all(from.positions_f64, to.positions_f64);
  append_all(from.normals, to.normals);
  if (!from.uvs.empty() || !to.uvs.empty()) {
    to.uvs.resize(base, no_uv);
    from.uvs.resize(vertex_count(from), no_uv);
    append_all(from.uvs, to.uvs);
  }
  for (const Triangle& t : from.triangles)
    to.triangles.push_back({base + t[0], base + t[1], base + t[2]});
}

/// Reads one document.
class Reader {
 public:
  explicit Reader(Document& document) : document_(document) {}

  Result<MeshFile> read() {
    find_draws();
    if (document_.fault()) return fault();
    if (auto counted = check_counts(); !counted) return tl::unexpected(counted.error());
    const bool f64 = is_far_out();
    for (const Draw& draw : draws_)
      for (const Primitive& primitive : meshes_.at(draw.mesh).primitives)
        if (auto done = add(draw, primitive, f64); !done) return tl::unexpected(done.error());
    if (file_.triangles.empty()) return problem("holds no triangles");
    finish();
    return std::move(file_);
  }

 private:
  tl::unexpected<Problem> fault() const {
    return problem("is not sound glTF: " + *document_.fault());
  }

  void find_draws() {
    const Value root = document_.root(), nodes = root["nodes"], meshes = root["meshes"];
    const std::vector<std::string> materials = material_names(document_);
    for (const PlacedNode& node : placed_nodes(document_)) {
      if (document_.fault()) return;
      const Value value = nodes[node.index];
      const auto mesh = value["mesh"].index(meshes.size());
      if (!mesh) continue;
      has_skins_ = has_skins_ || value["skin"];
      const auto [place, is_new] = meshes_.try_emplace(*mesh);
      if (is_new)
        place->second = {open_primitives(document_, meshes[*mesh], materials, file_.skipped_faces),
                         weights_of(meshes[*mesh]["weights"]),
                         has_colors(meshes[*mesh]["primitives"])};
      if (place->second.has_colors) colored_.push_back(name_of_node(document_, node.index));
      std::vector<double> weights =
          value["weights"] ? weights_of(value["weights"]) : place->second.weights;
      for (const Primitive& primitive : place->second.primitives) {
        weights.resize(std::max(weights.size(), primitive.targets.size()));
        has_normals_ = has_normals_ || primitive.normals;
      }
      for (const Placement& instance : instances_of(document_, value))
        draws_.push_back({node.index, *mesh, {node.to_world * instance, weights}});
    }
  }

  /// Before anything is expanded.
  Result<void> check_counts() const {
    std::uint64_t triangles = 0, vertices = 0;
    for (const Draw& draw : draws_)
      for (const Primitive& primitive : meshes_.at(draw.mesh).primitives) {
        triangles += primitive.triangles();
        vertices += primitive.positions.size();
        if (triangles > limits::max_triangles || vertices > 3 * limits::max_triangles)
          return problem("holds more than " + std::to_string(limits::max_triangles) +
                         " faces, which are the most that are allowed");
      }
    return {};
  }

  bool is_far_out() const {
    Eigen::AlignedBox3d box;
    for (const Draw& draw : draws_) {
      if (draw.drawn.to_world.is_identity()) continue;  // f32, as the file has it.
      for (const Primitive& primitive : meshes_.at(draw.mesh).primitives)
        box.extend(gltf::box_of(primitive, draw.drawn));
    }
    return !box.isEmpty() &&
           box.center().cwiseAbs().maxCoeff() > far_times_its_size * box.sizes().maxCoeff();
  }

  Result<void> add(const Draw& draw, const Primitive& primitive, bool f64) {
    const std::string object = name_of_node(document_, draw.node);
    const std::uint64_t first = file_.triangles.size();
    if (has_normals_ && !primitive.normals) {
      MeshFile apart;
      if (auto done = append(primitive, draw.drawn, f64, apart); !done) return done;
      apart.normals.clear();
      creased_normals(apart, crease_angle);
      join(std::move(apart), file_);
    } else if (auto done = append(primitive, draw.drawn, f64, file_); !done) {
      return done;
    }
    const std::uint64_t count = file_.triangles.size() - first;
    if (count == 0) return {};
    const bool goes_on = !file_.pieces.empty() && file_.pieces.back().object == object &&
                         file_.pieces.back().material == primitive.material;
    if (goes_on)
      file_.pieces.back().triangles += count;
    else
      file_.pieces.push_back({object, primitive.material, first, count});
    return {};
  }

  void finish() {
    if (!has_normals_) {
      file_.normals.clear();
      file_.crease_angle = crease_angle;
    }
    if (!colored_.empty())
      file_.notes.push_back("vertex colours (COLOR_0) of " + listed(colored_) + " were left out");
    if (has_skins_) file_.notes.push_back("skins are left out: meshes stand as they were modelled");
    if (document_.root()["animations"].size() > 0)
      file_.notes.push_back("animations are left out: nodes stand where they stand by default");
  }

  Document& document_;
  std::map<std::size_t, OpenMesh> meshes_;
  std::vector<Draw> draws_;
  bool has_normals_ = false, has_skins_ = false;
  std::vector<std::string> colored_;  ///< Nodes with vertex colours.
  MeshFile file_;
};

}  // namespace
}  // namespace metamer::gltf

namespace metamer {

Result<MeshFile> read_gltf(const Bytes& bytes, const std::string& name, const MeshBytes& files) {
  auto document = gltf::Document::open(bytes, name, files);
  if (!document) return tl::unexpected(document.error());
  return gltf::Reader(*document).read();
}

}  // namespace metamer
