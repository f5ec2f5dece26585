#include "server/cpu/embree_scene.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <cmath>
#include <new>
#include <numbers>

#include "server/cpu/isa/isa.h"
#include "server/scene/placement.h"

namespace metamer::cpu {
namespace {

std::array<float, 3> to_array(const Eigen::Vector3d& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// A normal's map to the world: the inverse transpose, up to a factor that keeps it near 1.
Eigen::Matrix3d normal_map(const Eigen::Affine3d& to_world) {
  const Eigen::Matrix3d map = to_world.linear().inverse().transpose();
  return map / map.norm();
}

/// The factor of a map that turns, and scales all directions alike.
std::optional<double> uniform_scale(const Eigen::Matrix3d& map) {
  const Eigen::Matrix3d squared = map.transpose() * map;
  const double scale = squared(0, 0);
  const bool uniform =
      (squared - scale * Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= 1e-9 * scale;
  return uniform ? std::optional(std::sqrt(scale)) : std::nullopt;
}

std::array<std::array<float, 4>, 3> rows(const Eigen::Affine3d& map) {
  std::array<std::array<float, 4>, 3> to;
  for (Eigen::Index row = 0; row < 3; ++row)
    for (Eigen::Index column = 0; column < 4; ++column)
      to[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] =
          static_cast<float>(map(row, column));
  return to;
}

/// Calls `each(i)` for all below `count`, on all threads of the arena.
template <class Each>
void for_all(std::size_t count, Each each) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 1 << 14),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i) each(i);
                    });
}

/// Embree says that it got no memory by a code, and goes on with what it has.
void throw_if_out_of_memory(RTCDevice device) {
  if (rtcGetDeviceError(device) == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
}

RTCGeometry triangles(RTCDevice device, const TriangleMesh& mesh, const Eigen::Vector3d& center,
                      const Eigen::Affine3d& place) {
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* vertices = static_cast<Float3*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                                RTC_FORMAT_FLOAT3, sizeof(Float3),
                                                                mesh.positions.size()));
  if (vertices == nullptr) throw std::bad_alloc();
  for_all(mesh.positions.size(), [&](std::size_t i) {
    vertices[i] = to_array(place * (to_vector(mesh.positions[i]) - center));
  });
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                             mesh.triangles.data(), 0, sizeof(Triangle), mesh.triangles.size());
  return geometry;
}

/// A mesh's normals in the world, mapped but not made unit again: so that interpolating between
/// them is the same before and after the map.
std::vector<Float3> mapped_normals(const TriangleMesh& mesh, const Eigen::Matrix3d& map) {
  std::vector<Float3> normals(mesh.normals.size());
  for_all(normals.size(),
          [&](std::size_t i) { normals[i] = to_array(map * to_vector(mesh.normals[i])); });
  return normals;
}

/// Where a mesh's own space has its origin for f32: in its middle, if it is finer than that.
Eigen::Vector3d center_of(const TriangleMesh& mesh) {
  if (mesh.positions.f64().empty()) return Eigen::Vector3d::Zero();
  return box_of(mesh.positions).center();
}

/// Of a sphere, around half of whose great circle v goes, and of a plane, by its own metres.
float uv_density(const RenderObject& object) {
  const Eigen::Matrix3d axes = object.to_world.linear();
  const double length = object.shape == RenderObject::Shape::plane
                            ? std::sqrt(axes.col(0).cross(axes.col(2)).norm())
                            : std::numbers::pi * std::cbrt(std::abs(axes.determinant()));
  return static_cast<float>(1 / length);
}

bool keep_building(void* cancelled, double) {
  return !static_cast<const std::atomic<bool>*>(cancelled)->load(std::memory_order_relaxed);
}

const Float3* vertices_of(RTCGeometry geometry) {
  return static_cast<const Float3*>(rtcGetGeometryBufferData(geometry, RTC_BUFFER_TYPE_VERTEX, 0));
}

}  // namespace

std::optional<EmbreeScene> EmbreeScene::build(const RenderScene& scene,
                                              const std::atomic<bool>& cancelled) {
  EmbreeScene result;
  const std::string limit = embree_isa().empty() ? "" : ",isa=" + embree_isa();
  result.device_.reset(rtcNewDevice(("tessellation_cache_size=0" + limit).c_str()));
  const RTCDevice device = result.device_.get();
  // Then it is looked with every hit whether it counts.
  result.passed_ = !scene.media.empty() || scene.has_alpha();
  const auto new_scene = [&] {
    RTCScene handle = result.empty_scene();
    rtcSetSceneProgressMonitorFunction(handle, keep_building,
                                       const_cast<std::atomic<bool>*>(&cancelled));
    return SceneHandle(handle);
  };
  result.scene_ = new_scene();

  // Build the meshes that several objects share, each in its own space.
  std::vector<unsigned> uses(scene.meshes.size());
  for (const RenderObject& object : scene.objects)
    if (object.shape == RenderObject::Shape::mesh) ++uses[object.mesh];
  result.shared_scenes_.resize(scene.meshes.size());
  std::vector<const Float3*> vertices(scene.meshes.size());
  std::vector<Eigen::Vector3d> centers;
  for (const TriangleMesh& mesh : scene.meshes) centers.push_back(center_of(mesh));
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    if (uses[i] < 2) continue;
    result.shared_scenes_[i] = new_scene();
    RTCGeometry geometry =
        triangles(device, scene.meshes[i], centers[i], Eigen::Affine3d::Identity());
    vertices[i] = vertices_of(geometry);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(result.shared_scenes_[i].get(), geometry);
    rtcReleaseGeometry(geometry);
    rtcJoinCommitScene(result.shared_scenes_[i].get());
    if (cancelled) return std::nullopt;
  }

  // Place every object.
  for (const RenderObject& object : scene.objects) {
    const bool sphere = object.shape != RenderObject::Shape::mesh;  // or a plane: no corners
    result.tangents_ |= scene.materials[object.material].anisotropic();
    result.interpolated_ |= !sphere && object.shading != v1::PHONG;
    RenderObject centered = object;
    if (!sphere) centered.to_world.translate(centers[object.mesh]);
    result.placed_.push_back({.material = object.material,
                              .shading = sphere ? v1::PHONG : object.shading,
                              .mesh = sphere ? nullptr : &scene.meshes[object.mesh],
                              .to_world = rows(centered.to_world),
                              .from_world = rows(object.to_world.inverse()),
                              .uv_density = sphere ? uv_density(object) : 0,
                              .plane = object.shape == RenderObject::Shape::plane});
    if (result.placed_.back().plane)
      result.planes_.add(static_cast<std::uint32_t>(result.placed_.size() - 1), object);
    else if (sphere)
      result.add_sphere(object);
    if (sphere) continue;
    Placed& placed = result.placed_.back();
    for (std::size_t axis = 0; axis < 3; ++axis)
      placed.center[axis] = centers[object.mesh][static_cast<Eigen::Index>(axis)];
    const bool is_shared = uses[object.mesh] >= 2;
    // Normals, and an instance's triangles, are mapped; a flat triangle is seen by its corners.
    placed.mirrored =
        !is_shared && placed.mesh->normals.empty() && object.to_world.linear().determinant() < 0;
    if (!is_shared)
      result.add_placed(centered, *placed.mesh);
    else
      result.add_instance(centered, result.shared_scenes_[object.mesh].get(),
                          vertices[object.mesh]);
  }
  rtcJoinCommitScene(result.scene_.get());
  if (cancelled) return std::nullopt;
  throw_if_out_of_memory(device);
  return result;
}

RTCScene EmbreeScene::empty_scene() const {
  RTCScene scene = rtcNewScene(device_.get());
  // A path that slipped between two triangles would be in a medium that it never entered.
  if (passed_)
    rtcSetSceneFlags(scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION |
                                                       RTC_SCENE_FLAG_ROBUST));
  return scene;
}

/// Gives the newest of the placed objects its geometry.
void EmbreeScene::attach(RTCGeometry geometry) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene_.get(), geometry, static_cast<unsigned>(placed_.size() - 1));
  rtcReleaseGeometry(geometry);
}

void EmbreeScene::add_placed(const RenderObject& object, const TriangleMesh& mesh) {
  Placed& placed = placed_.back();
  placed.normals = normals_.emplace_back(mapped_normals(mesh, normal_map(object.to_world))).data();
  if (mesh.normals.empty()) placed.normals = nullptr;
  RTCGeometry geometry = triangles(device_.get(), mesh, to_vector(placed.center), object.to_world);
  placed.vertices = vertices_of(geometry);
  attach(geometry);
}

void EmbreeScene::add_sphere(const RenderObject& object) {
  // Its size apart from its shape: a shape's numbers lie near 1 however small the sphere is.
  const int exponent = exponent_of(object.to_world.linear());
  const Eigen::Matrix3d shape = scaled_by_two_to(-exponent, object.to_world.linear());
  const auto sphere = [&](const Eigen::Vector3d& center, double radius) {
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_SPHERE_POINT);
    auto* vertex = static_cast<std::array<float, 4>*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, sizeof(std::array<float, 4>), 1));
    const auto c = to_array(center);
    *vertex = {c[0], c[1], c[2], static_cast<float>(radius)};
    return geometry;
  };
  Ball& ball_of = placed_.back().ball;
  ball_of.center = to_array(object.to_world.translation());
  if (const auto scale = uniform_scale(shape)) {
    const double radius = std::ldexp(*scale, exponent);
    ball_of.from_world = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    ball_of.radius = static_cast<float>(radius);
    attach(sphere(object.to_world.translation(), radius));
    return;
  }
  const Eigen::Matrix3d from_world = shape.inverse();
  for (Eigen::Index row = 0; row < 3; ++row)
    ball_of.from_world[static_cast<std::size_t>(row)] = to_array(from_world.row(row).transpose());
  ball_of.radius = static_cast<float>(std::ldexp(1.0, exponent));
  // An ellipsoid is an instance of a sphere of about its size.
  RTCScene ball = empty_scene();
  RTCGeometry geometry = sphere(Eigen::Vector3d::Zero(), std::ldexp(1.0, exponent));
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(ball, geometry);
  rtcReleaseGeometry(geometry);
  rtcJoinCommitScene(ball);
  shared_scenes_.emplace_back(ball);
  RenderObject shaped = object;
  shaped.to_world.linear() = shape;
  add_instance(shaped, ball, nullptr);
}

void EmbreeScene::add_instance(const RenderObject& object, RTCScene shared,
                               const Float3* vertices) {
  RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, shared);
  const Eigen::Matrix<float, 3, 4, Eigen::RowMajor> map = object.to_world.affine().cast<float>();
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_ROW_MAJOR, map.data());
  Placed& placed = placed_.back();
  if (placed.mesh != nullptr && !placed.mesh->normals.empty())
    placed.normals = placed.mesh->normals.data();
  placed.vertices = vertices;
  placed.instance = true;
  const Eigen::Matrix3d normal = normal_map(object.to_world);
  for (int row = 0; row < 3; ++row)
    placed.to_world_normals[static_cast<std::size_t>(row)] = to_array(normal.row(row).transpose());
  attach(geometry);
}

}  // namespace metamer::cpu
