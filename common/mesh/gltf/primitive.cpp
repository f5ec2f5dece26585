#include "common/mesh/gltf/primitive.h"

#include <cstring>
#include <limits>

#include "common/mesh/parallel.h"
#include "common/mesh/vertex.h"

namespace metamer::gltf {
namespace {

constexpr std::uint64_t most_modes = 6;

/// Elements that a primitive of points or lines draws.
std::size_t points_and_lines(std::uint64_t mode, std::size_t corners) {
  if (mode == 1) return corners / 2;                    // lines
  if (mode == 3) return corners > 0 ? corners - 1 : 0;  // a strip
  return corners;                                       // points, a loop
}

std::vector<Primitive::Target> open_targets(Document& document, const Value& targets,
                                            std::size_t vertices) {
  std::vector<Primitive::Target> list;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    auto& target = list.emplace_back();
    target.positions = Accessor::open(document, targets[i]["POSITION"], {"VEC3"});
    target.normals = Accessor::open(document, targets[i]["NORMAL"], {"VEC3"});
    for (const auto* part : {&target.positions, &target.normals})
      if (*part && (*part)->size() != vertices)
        targets[i].fault("has not as many elements as there are vertices");
  }
  return list;
}

std::optional<Primitive> open_primitive(Document& document, const Value& value,
                                        const std::vector<std::string>& material_names) {
  const Value attributes = value["attributes"];
  auto positions = Accessor::open(document, attributes["POSITION"], {"VEC3"});
  if (!positions) return std::nullopt;  // Nothing that could be drawn.
  Primitive primitive{.positions = *std::move(positions)};
  primitive.normals = Accessor::open(document, attributes["NORMAL"], {"VEC3"});
  primitive.uvs = Accessor::open(document, attributes["TEXCOORD_0"], {"VEC2"});
  for (const auto* part : {&primitive.normals, &primitive.uvs})
    if (*part && (*part)->size() != primitive.positions.size())
      attributes.fault("have not as many elements each");
  primitive.indices = Accessor::open(document, value["indices"], {"SCALAR"});
  if (primitive.indices && primitive.indices->type() != Accessor::Type::u8 &&
      primitive.indices->type() != Accessor::Type::u16 &&
      primitive.indices->type() != Accessor::Type::u32)
    value["indices"].fault("are not whole numbers without a sign");
  primitive.targets = open_targets(document, value["targets"], primitive.positions.size());
  if (const auto at = value["material"].index(material_names.size()))
    primitive.material = material_names[*at];
  return primitive;
}

/// Element `i`, with what the targets add to it.
Double3 morphed(const Accessor& base, const std::vector<const Accessor*>& targets,
                const std::vector<double>& weights, std::size_t i) {
  Double3 value;
  for (std::size_t c = 0; c < 3; ++c) {
    value[c] = base.number(i, c);
    for (std::size_t t = 0; t < targets.size(); ++t)
      if (targets[t] != nullptr) value[c] += weights[t] * targets[t]->number(i, c);
  }
  return value;
}

/// The targets that do something, of one attribute.
template <class Member>
std::vector<const Accessor*> targets_of(const Primitive& primitive, const Drawn& drawn,
                                        Member member) {
  std::vector<const Accessor*> list;
  for (std::size_t i = 0; i < primitive.targets.size(); ++i) {
    const auto& target = primitive.targets[i].*member;
    list.push_back(target && drawn.weights[i] != 0 ? &*target : nullptr);
  }
  if (std::all_of(list.begin(), list.end(), [](const Accessor* one) { return one == nullptr; }))
    list.clear();
  return list;
}

Double3 mapped(const Placement& map, const Double3& p) {
  const Eigen::Vector3d q = map * Eigen::Vector3d(p.data());
  return {q.x(), q.y(), q.z()};
}

Result<void> append_positions(const Primitive& primitive, const Drawn& drawn, bool f64,
                              std::size_t base, MeshFile& to) {
  const std::size_t count = primitive.positions.size();
  if (f64)
    to.positions_f64.resize(base + count);
  else
    to.positions.resize(base + count);
  const auto targets = targets_of(primitive, drawn, &Primitive::Target::positions);
  const bool as_it_stands = !f64 && targets.empty() && primitive.positions.f32(0) != nullptr &&
                            drawn.to_world.is_identity();
  FirstProblem first;
  for_ranges(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Double3 p;
      if (as_it_stands) {
        Float3& at = to.positions[base + i];
        std::memcpy(&at, primitive.positions.f32(i), sizeof at);
        p = {at[0], at[1], at[2]};
      } else {
        p = mapped(drawn.to_world, morphed(primitive.positions, targets, drawn.weights, i));
        if (f64)
          to.positions_f64[base + i] = p;
        else
          to.positions[base + i] = to_f32(p);
      }
      if (is_position(p)) continue;
      first.keep(
          i, {.field = {},
              .file = {},
              .message = "vertex " + std::to_string(base + i) + " is not finite or too far out"});
      return;
    }
  });
  if (first.get()) return tl::unexpected(*first.get());
  return {};
}

void append_normals(const Primitive& primitive, const Drawn& drawn, std::size_t base,
                    MeshFile& to) {
  const std::size_t count = primitive.positions.size();
  to.normals.resize(base + count);
  if (!primitive.normals) return;
  // The cofactors: as the inverse transpose, also where a node is flattened.
  const Eigen::Matrix3d& a = drawn.to_world.linear;
  Eigen::Matrix3d map;
  map.col(0) = a.col(1).cross(a.col(2));
  map.col(1) = a.col(2).cross(a.col(0));
  map.col(2) = a.col(0).cross(a.col(1));
  if (a.determinant() < 0) map = -map;
  if (const double size = map.cwiseAbs().maxCoeff(); size > 0) map /= size;
  const auto targets = targets_of(primitive, drawn, &Primitive::Target::normals);
  for_ranges(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Double3 n = morphed(*primitive.normals, targets, drawn.weights, i);
      const Eigen::Vector3d world = map * Eigen::Vector3d(n.data());
      to.normals[base + i] = unit_or_none({world.x(), world.y(), world.z()});
    }
  });
}

Result<void> append_uvs(const Primitive& primitive, std::size_t base, MeshFile& to) {
  if (!primitive.uvs && to.uvs.empty()) return {};
  const std::size_t count = primitive.positions.size();
  to.uvs.resize(base, no_uv);
  to.uvs.resize(base + count, no_uv);
  if (!primitive.uvs) return {};
  FirstProblem first;
  for_ranges(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      // A glTF's v falls from the top of a picture.
      Float2& uv = to.uvs[base + i];
      uv = to_uv(primitive.uvs->number(i, 0), 1 - primitive.uvs->number(i, 1));
      if (is_uv(uv)) continue;
      first.keep(i, {.field = {},
                     .file = {},
                     .message = "the UV of vertex " + std::to_string(base + i) +
                                " is not finite or too far out"});
      return;
    }
  });
  if (first.get()) return tl::unexpected(*first.get());
  return {};
}

/// The corners of triangle `t`, by their place in the list of indices.
std::array<std::size_t, 3> corners_of(Primitive::Mode mode, std::size_t t) {
  switch (mode) {
    case Primitive::Mode::triangles:
      return {3 * t, 3 * t + 1, 3 * t + 2};
    case Primitive::Mode::strip:
      return t % 2 == 0 ? std::array{t, t + 1, t + 2} : std::array{t + 1, t, t + 2};
    case Primitive::Mode::fan:
      return {t + 1, t + 2, 0};
  }
  return {};
}

Result<void> append_triangles(const Primitive& primitive, const Drawn& drawn, std::size_t base,
                              MeshFile& to) {
  const bool turned = drawn.to_world.linear.determinant() < 0;
  const std::size_t count = primitive.triangles(), vertices = primitive.positions.size();
  const std::size_t begin_of_all = to.triangles.size();
  to.triangles.resize(begin_of_all + count);
  FirstProblem first;
  for_ranges(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      Triangle& triangle = to.triangles[begin_of_all + t];
      const auto corners = corners_of(primitive.mode, t);
      for (std::size_t c = 0; c < 3; ++c) {
        const std::size_t vertex =
            primitive.indices ? primitive.indices->whole(corners[c]) : corners[c];
        if (vertex >= vertices) {
          first.keep(
              t, {.field = {},
                  .file = {},
                  .message = "triangle " + std::to_string(begin_of_all + t) + " names vertex " +
                             std::to_string(vertex) + "; there are " + std::to_string(vertices)});
          return;
        }
        triangle[c] = static_cast<std::uint32_t>(base + vertex);
      }
      if (turned) std::swap(triangle[1], triangle[2]);
    }
  });
  if (first.get()) return tl::unexpected(*first.get());
  if (primitive.mode != Primitive::Mode::triangles) {
    // Strips are joined by triangles that have a vertex twice.
    const auto end = std::remove_if(
        to.triangles.begin() + static_cast<std::ptrdiff_t>(begin_of_all), to.triangles.end(),
        [](const Triangle& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
    to.triangles.erase(end, to.triangles.end());
  }
  return {};
}

}  // namespace

std::vector<Primitive> open_primitives(Document& document, const Value& mesh,
                                       const std::vector<std::string>& material_names,
                                       std::uint64_t& skipped) {
  std::vector<Primitive> list;
  const Value primitives = mesh["primitives"];
  for (std::size_t i = 0; i < primitives.size() && !document.fault(); ++i) {
    const std::uint64_t mode = primitives[i]["mode"].whole(most_modes, 4);
    auto primitive = open_primitive(document, primitives[i], material_names);
    if (!primitive) continue;
    if (mode < 4) {
      skipped += points_and_lines(mode, primitive->corners());
      continue;
    }
    primitive->mode = static_cast<Primitive::Mode>(mode);
    list.push_back(*std::move(primitive));
  }
  return list;
}

Result<void> append(const Primitive& primitive, const Drawn& drawn, bool f64, MeshFile& to) {
  const std::size_t base = vertex_count(to);
  if (base + primitive.positions.size() > std::numeric_limits<std::uint32_t>::max())
    return problem("has more vertices than 32 bits can count");
  if (auto done = append_positions(primitive, drawn, f64, base, to); !done) return done;
  append_normals(primitive, drawn, base, to);
  if (auto done = append_uvs(primitive, base, to); !done) return done;
  return append_triangles(primitive, drawn, base, to);
}

Eigen::AlignedBox3d box_of(const Primitive& primitive, const Drawn& drawn) {
  Eigen::AlignedBox3d box;
  const auto targets = targets_of(primitive, drawn, &Primitive::Target::positions);
  for (std::size_t i = 0; i < primitive.positions.size(); ++i) {
    const Double3 p =
        mapped(drawn.to_world, morphed(primitive.positions, targets, drawn.weights, i));
    box.extend(Eigen::Vector3d(p.data()));
  }
  return box;
}

}  // namespace metamer::gltf
