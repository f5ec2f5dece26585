#include "server/gl/geometry.h"

#include <epoxy/gl.h>

#include <bit>
#include <limits>

#include "metamer/v1/scene.pb.h"
#include "server/gl/boxes.h"
#include "server/scene/placement.h"

namespace metamer::gl {
namespace {

constexpr std::uint32_t first_sphere = 0x80000000u;  // as geometry.glsl has it

/// As geometry.glsl has it.
struct Object {
  float to_unit[3][4];
  float x_axis[4];
  float z_axis[4];
  std::uint32_t material, shading, has_normals, padding;
};
static_assert(sizeof(Object) == 96);

/// All objects as flat lists.
struct Lists {
  std::vector<float> positions, normals, tangents;
  std::vector<std::uint32_t> corners, owners;
  std::vector<Object> objects;
  std::vector<float> sphere_boxes;  ///< Rows of each box's way from the unit box, and its object.
  std::vector<BoxedPrimitive> primitives;
};

void append(std::vector<float>& to, const Eigen::Vector3d& v) {
  for (int i = 0; i < 3; ++i) to.push_back(static_cast<float>(v[i]));
}

void add_rows(const Eigen::Affine3d& map, float (&to)[3][4]) {
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      to[row][column] = static_cast<float>(map(row, column));
}

/// A box around a point set by f32's rounding outwards, so that no ray slips past it.
Eigen::AlignedBox3f rounded(Eigen::AlignedBox3f box) {
  const float slack = 4 * std::numeric_limits<float>::epsilon() *
                      std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  box.min().array() -= slack;
  box.max().array() += slack;
  return box;
}

void add_mesh(const RenderObject& object, const TriangleMesh& mesh, bool tangents, Lists& to) {
  const auto base = static_cast<std::uint32_t>(to.positions.size() / 3);
  const auto owner = static_cast<std::uint32_t>(to.objects.size());
  const Eigen::Matrix3d inverse = object.to_world.linear().inverse().transpose();
  const Eigen::Matrix3d normal_map = inverse / inverse.norm();
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    append(to.positions, object.to_world * to_vector(mesh.positions[i]));
    append(to.normals, mesh.normals.empty()
                           ? Eigen::Vector3d(0, 0, 0)
                           : Eigen::Vector3d(normal_map * to_vector(mesh.normals[i])));
    if (tangents)
      append(to.tangents, mesh.tangents.empty() ? Eigen::Vector3d(0, 0, 0)
                                                : Eigen::Vector3d(object.to_world.linear() *
                                                                  to_vector(mesh.tangents[i])));
  }
  for (const auto& triangle : mesh.triangles) {
    BoxedPrimitive primitive{{}, static_cast<std::uint32_t>(to.owners.size())};
    for (const std::uint32_t corner : triangle) {
      to.corners.push_back(base + corner);
      const float* at = &to.positions[3 * std::size_t{base + corner}];
      primitive.box.extend(Eigen::Vector3f(at[0], at[1], at[2]));
    }
    primitive.box = rounded(primitive.box);
    to.primitives.push_back(primitive);
    to.owners.push_back(owner);
  }
}

/// The box around a sphere that is stretched by a map: E = |row of the map| along each axis.
void add_sphere(const RenderObject& object, Object& record, Lists& to) {
  add_rows(object.to_world.inverse(), record.to_unit);
  const auto owner = static_cast<std::uint32_t>(to.objects.size());
  const Eigen::Vector3d center = object.to_world.translation();
  const Eigen::Vector3d reach = object.to_world.linear().rowwise().norm();
  const Eigen::AlignedBox3f box = rounded({Eigen::Vector3d(center - reach).cast<float>(),
                                           Eigen::Vector3d(center + reach).cast<float>()});
  to.primitives.push_back({box, first_sphere | owner});

  const Eigen::Vector3f middle = box.center(), half = 0.5f * box.sizes();
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 4; ++column)
      to.sphere_boxes.push_back(column == row ? half[row] : column == 3 ? middle[row] : 0);
  to.sphere_boxes.insert(to.sphere_boxes.end(), {std::bit_cast<float>(owner), 0, 0, 0});
}

Lists flatten(const RenderScene& scene, bool tangents) {
  Lists lists;
  for (const RenderObject& object : scene.objects) {
    const bool sphere = object.shape == RenderObject::Shape::sphere;
    Object record{};
    const Eigen::Matrix3d axes = object.to_world.linear();
    for (int i = 0; i < 3; ++i) {
      record.x_axis[i] = static_cast<float>(axes(i, 0));
      record.z_axis[i] = static_cast<float>(axes(i, 2));
    }
    record.material = object.material;
    record.shading =
        sphere ? static_cast<std::uint32_t>(v1::PHONG) : static_cast<std::uint32_t>(object.shading);
    if (sphere) {
      add_sphere(object, record, lists);
    } else {
      const TriangleMesh& mesh = scene.meshes[object.mesh];
      record.has_normals = !mesh.normals.empty();
      add_mesh(object, mesh, tangents, lists);
    }
    lists.objects.push_back(record);
  }
  return lists;
}

bool any_tangents(const RenderScene& scene) {
  bool anisotropic = false, tangents = false;
  for (const RenderMaterial& material : scene.materials) anisotropic |= material.anisotropic();
  for (const TriangleMesh& mesh : scene.meshes) tangents |= !mesh.tangents.empty();
  return anisotropic && tangents;
}

}  // namespace

Result<Geometry> Geometry::upload(const RenderScene& scene, const std::atomic<bool>& cancelled) {
  Geometry result;
  result.has_tangents_ = any_tangents(scene);
  const Lists lists = flatten(scene, result.has_tangents_);
  const auto boxes = build_boxes(lists.primitives, cancelled);
  if (!boxes) return problem("");
  result.triangle_count_ = static_cast<std::uint32_t>(lists.owners.size());
  result.sphere_count_ = static_cast<std::uint32_t>(lists.sphere_boxes.size() / 16);
  result.node_count_ = static_cast<std::uint32_t>(boxes->low.size());

  // Upload.
  Problem trouble;
  const auto upload = [&](Buffer& to, const char* what, auto& values) {
    if (!trouble.message.empty()) return;
    using Value = typename std::decay_t<decltype(values)>::value_type;
    auto buffer = Buffer::of<Value>(what, values);
    if (buffer)
      to = std::move(*buffer);
    else
      trouble = buffer.error();
  };
  upload(result.positions_, "the vertices' positions", lists.positions);
  upload(result.normals_, "the vertices' normals", lists.normals);
  upload(result.tangents_, "the vertices' tangents", lists.tangents);
  upload(result.corners_, "the triangles' corners", lists.corners);
  upload(result.owners_, "the triangles' objects", lists.owners);
  upload(result.objects_, "the objects", lists.objects);
  upload(result.boxes_, "the spheres' boxes", lists.sphere_boxes);
  upload(result.low_, "the boxes for shadows", boxes->low);
  upload(result.high_, "the boxes for shadows", boxes->high);
  upload(result.primitives_, "the primitives in boxes", boxes->primitives);
  if (!trouble.message.empty()) return tl::unexpected(trouble);
  return result;
}

void Geometry::bind() const {
  const Buffer* const order[] = {&positions_, &corners_, &objects_,   &boxes_,
                                 &low_,       &high_,    &primitives_};
  for (unsigned i = 0; i < std::size(order); ++i) order[i]->bind_storage(i);
  normals_.bind_storage(9);
  tangents_.bind_storage(10);
  owners_.bind_storage(11);
}

void Geometry::draw(const Program& triangles, const Program& spheres) const {
  glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  if (triangle_count_ > 0) {
    triangles.use();
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, corners_.name());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(3 * triangle_count_), GL_UNSIGNED_INT,
                   nullptr);
  }
  if (sphere_count_ > 0) {
    spheres.use();
    boxes_.bind_storage(3);  // where a compute shader finds the places of triangles
    glDrawArraysInstanced(GL_TRIANGLES, 0, 36, static_cast<GLsizei>(sphere_count_));
  }
}

}  // namespace metamer::gl
