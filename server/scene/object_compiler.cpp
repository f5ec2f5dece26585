#include "server/scene/object_compiler.h"

#include <cmath>
#include <limits>
#include <utility>

#include "common/scene/limits.h"
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

}  // namespace

void ObjectCompiler::object(int index) {
  const v1::Object& object = to_.scene.object(index);
  RenderObject to{
      .name = object.name(),
      .shape = RenderObject::Shape::mesh,
      .mesh = 0,
      .material = material_named(object.material()),
      .shading = object.has_shading() ? object.shading() : to_.scene.settings().shading(),
      .to_world = placement(object.transform())};
  switch (object.shape_case()) {
    case v1::Object::kMesh:
      to.mesh = meshes_.at(mesh_key(object.mesh()));
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
      if (to_.result.materials[to.material].medium > 0)
        to_.add("object[" + std::to_string(index) + "].plane",
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
  const RenderMaterial& material = to_.result.materials[to.material];
  if (material.turns_normals() && to.shading != v1::PHONG) {
    if (!std::exchange(told_of_phong_, true))
      to_.result.notices.push_back({"object[" + std::to_string(index) + "]",
                                    "a picture turns its normals: it, and all like it, are shaded "
                                    "by PHONG"});
    to.shading = v1::PHONG;
  }
  if (to.shape == RenderObject::Shape::mesh && material.has_picture() &&
      to_.result.meshes[to.mesh].uvs.empty())
    to_.add("object[" + std::to_string(index) + "]",
            "its mesh has no UVs, which the " +
                std::string(material.texture      ? "texture"
                            : material.normal_map ? "normal map"
                            : material.bump_map   ? "bump map"
                                                  : "alpha") +
                " of " + quoted(object.material()) + " needs");
  to_.result.objects.push_back(std::move(to));
}

/// Mesh and transform are each within bounds; what they make together has to be, too.
void ObjectCompiler::check_place(const RenderObject& object, const std::string& field) {
  Eigen::AlignedBox3d box(Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(1));
  if (object.shape == RenderObject::Shape::mesh) box = bounds(object.mesh);
  if (object.shape == RenderObject::Shape::plane)
    box = Eigen::AlignedBox3d(Eigen::Vector3d(0, 0, 0));
  if (box.isEmpty()) return;
  const Eigen::AlignedBox3d placed = box.transformed(object.to_world);
  const double reach =
      std::max(placed.min().cwiseAbs().maxCoeff(), placed.max().cwiseAbs().maxCoeff());
  if (!(reach <= limits::max_coordinate))
    to_.add(field, "reaches " + shown(reach) + " from the origin; at most " +
                       shown(limits::max_coordinate) + " is allowed");
  else if (object.shape == RenderObject::Shape::sphere)
    check_axes(object.to_world.linear(), field);
}

/// An ellipsoid is traced in a space of its own, where rays have to stay within bounds, too.
void ObjectCompiler::check_axes(const Eigen::Matrix3d& axes, const std::string& field) {
  const Eigen::Matrix3d near_one = scaled_by_two_to(-exponent_of(axes), axes);
  const double ratio = near_one.determinant() != 0 ? near_one.norm() * near_one.inverse().norm()
                                                   : std::numeric_limits<double>::infinity();
  if (!(ratio <= max_axis_ratio))
    to_.add(field, "its axes differ by a factor of " + shown(ratio) + "; at most " +
                       shown(max_axis_ratio) + " is allowed");
}

/// The box around a mesh in its own space, computed the first time that it is asked for.
const Eigen::AlignedBox3d& ObjectCompiler::bounds(std::uint32_t mesh) {
  while (mesh_bounds_.size() <= mesh) {
    Eigen::AlignedBox3d& box = mesh_bounds_.emplace_back();
    box = box_of(to_.result.meshes[mesh_bounds_.size() - 1].positions);
  }
  return mesh_bounds_[mesh];
}

void ObjectCompiler::import_files(const MeshImport& import, const std::atomic<bool>& cancelled) {
  for (const MeshRequest& request : mesh_requests(to_.scene, needs_)) {
    if (cancelled) return;
    take_meshes(import(request), request);
  }
}

void ObjectCompiler::take_meshes(Result<std::vector<TriangleMesh>> imported,
                                 const MeshRequest& request) {
  if (!imported) {
    to_.problems.push_back(std::move(imported.error()));
    imported.emplace(request.meshes.size());  // Objects are checked all the same.
  }
  for (std::size_t i = 0; i < request.meshes.size(); ++i) {
    meshes_[request.meshes[i].key] = static_cast<std::uint32_t>(to_.result.meshes.size());
    to_.note((*imported)[i].notes, request.meshes[i].field + ".file");
    to_.result.meshes.push_back(std::move((*imported)[i]));
  }
}

/// A quad is a mesh of its own around its corner, where f32 is finest.
std::uint32_t ObjectCompiler::quad(const v1::Quad& quad) {
  const Eigen::Vector3d u = to_vector(quad.u()), v = to_vector(quad.v());
  const auto f32 = [](const Eigen::Vector3d& p) {
    return Float3{static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
  };
  TriangleMesh mesh;
  mesh.positions = Array<Float3>(std::vector<Float3>{{}, f32(u), f32(u + v), f32(v)});
  mesh.triangles = std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}};
  if (needs_.tangents) mesh.tangents = std::vector<Float3>(4, f32(unit(u)));
  if (needs_.uvs) mesh.uvs = std::vector<Float2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  to_.result.meshes.push_back(std::move(mesh));
  return static_cast<std::uint32_t>(to_.result.meshes.size() - 1);
}

std::uint32_t ObjectCompiler::material_named(const std::string& name) {
  if (materials_.empty())
    for (int i = 0; i < to_.scene.material_size(); ++i)
      materials_[to_.scene.material(i).name()] = static_cast<std::uint32_t>(i);
  return materials_.at(name);  // validate_scene has seen to it
}

}  // namespace metamer
