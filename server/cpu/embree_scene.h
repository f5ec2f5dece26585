#pragma once

#include <embree3/rtcore.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "server/cpu/corners.h"
#include "server/cpu/embree_packet.h"
#include "server/cpu/lanes.h"
#include "server/cpu/planes.h"
#include "server/scene/render_scene.h"

namespace metamer::cpu {

/// What the rays of a packet have met.
struct Hits {
  Ints hit;                  ///< Mask.
  Floats distance;           ///< Along the ray, where it hit.
  Ints material{};           ///< Index into RenderScene::materials, where it hit.
  Vectors geometric_normal;  ///< Unit, on the ray's side.
  Vectors normal;            ///< Unit: interpolated where the mesh has normals; on the same side.
  Vectors tangent{};         ///< Of any length; only in scenes that look at it.
  Ints object{};             ///< For EmbreeScene::shading and corners.
  Ints primitive{};          ///< The triangle of that object.
  Floats u{}, v{};           ///< Barycentric, of its second and third corner.
  Ints interpolated{};       ///< Mask: the object's shading is not PHONG.
  Ints inverted{};           ///< Mask: `normal` is opposite to the surface's own.
  Ints behind{};             ///< Mask: the ray met the back of the surface, by Embree's normal.
};

/// Surfaces that the rays of a packet have passed, a few for each: objects and primitives.
class Passed {
 public:
  static constexpr std::size_t most = 8;

  /// Of one more than `most` nothing is kept.
  void add(unsigned lane, int object, int primitive) {
    if (count_[lane] < most) surfaces_[lane][count_[lane]++] = {object, primitive};
  }
  bool has(unsigned lane, int object, int primitive) const {
    for (std::size_t i = 0; i < count_[lane]; ++i)
      if (surfaces_[lane][i] == std::pair(object, primitive)) return true;
    return false;
  }

 private:
  std::array<std::array<std::pair<int, int>, most>, lane_count> surfaces_{};
  std::array<std::size_t, lane_count> count_{};
};

/// The geometry in Embree; refers to the scene that it was built from. An object whose mesh no
/// other object shares is placed in the world once and for all; shared meshes are instances.
/// Immutable and shared by all threads.
class EmbreeScene {
 public:
  /// Nothing when `cancelled` becomes true during the build. Uses the threads of the calling arena.
  static std::optional<EmbreeScene> build(const RenderScene& scene,
                                          const std::atomic<bool>& cancelled);
  static std::optional<EmbreeScene> build(RenderScene&&, const std::atomic<bool>&) = delete;

  /// The first hits of rays with unit directions. Lanes outside `active`, and rays that are
  /// not finite, hit nothing and never reach Embree (it would abort).
  Hits intersect(const Vectors& origin, const Vectors& direction, Ints active) const;

  /// The same of the segments origin + t direction, 0 < t < length, but for what they have passed;
  /// in scenes with media or alpha.
  Hits intersect_others(const Vectors& origin, const Vectors& direction, Floats length, Ints active,
                        const Passed& passed) const;

  /// Which of the segments origin + t direction, 0 < t < length, are free. Inactive lanes and rays
  /// that are not finite are not.
  Ints visible(const Vectors& origin, const Vectors& direction, Floats length, Ints active) const;

  /// Of an object that was hit. A sphere's shading is PHONG; it has no corners.
  v1::Shading shading(int object) const {
    return placed_[static_cast<std::size_t>(object)].shading;
  }
  Corners corners(int object, int primitive) const;
  /// Of the point `at` of an object, whose mesh has UVs if it is one; u and v are its barycentric
  /// coordinates in the triangle.
  SurfaceUv surface_uv(int object, int primitive, float u, float v,
                       const std::array<float, 3>& at) const;
  /// At the same point: by its triangle, or by the sphere's or plane's own UVs.
  SurfaceAxes surface_axes(int object, int primitive, const std::array<float, 3>& at) const;
  /// Whether its triangles are turned as in its mesh's own space, whatever its map does.
  bool is_instance(int object) const { return placed_[static_cast<std::size_t>(object)].instance; }

  RTCScene handle() const { return scene_.get(); }  ///< For benchmarks.

 private:
  struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
  };
  struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
  };
  using Device = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
  using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

  /// A sphere: |A (p − center)| = radius. A is near 1, however small the sphere is.
  struct Ball {
    std::array<std::array<float, 3>, 3> from_world;  ///< A, by rows.
    Float3 center;
    float radius;
  };
  /// An object, by the number of its geometry in the top scene.
  struct Placed {
    std::uint32_t material;
    v1::Shading shading;
    const TriangleMesh* mesh = nullptr;  ///< Null: a sphere or plane.
    const Float3* vertices = nullptr;    ///< In the world; an instance's in its own space.
    Ball ball{};                         ///< Of a sphere.
    std::array<std::array<float, 4>, 3> to_world{};  ///< Rows.
    const Float3* normals =
        nullptr;       ///< Of its vertices; an instance's in its own space. Null: flat.
    Double3 center{};  ///< Of the mesh's space, as `to_world` has it.
    std::array<std::array<float, 4>, 3> from_world{};  ///< Rows; of a sphere or plane.
    float uv_density = 0;                              ///< SurfaceUv's; of a sphere or plane.
    bool plane = false;
    bool mirrored = false;  ///< SurfaceAxes'.
    bool instance = false;
    std::array<std::array<float, 3>, 3> to_world_normals{};  ///< Rows; for an instance.
  };

  EmbreeScene() = default;
  Hits read(const RayHits& rays, const Vectors& origin, const Vectors& direction, Ints sound,
            const Passed* passed) const;
  struct MetTriangles;
  void find(const RayHits& rays, unsigned first, Ints same, MetTriangles& met, Hits& hits) const;
  static void meet_triangles(const MetTriangles& met, const Vectors& origin,
                             const Vectors& direction, Hits& hits);
  static void meet_sphere(const Placed& placed, const Vectors& origin, const Vectors& direction,
                          unsigned lane, Hits& hits);
  void add_placed(const RenderObject& object, const TriangleMesh& mesh);
  void add_sphere(const RenderObject& object);
  void add_instance(const RenderObject& object, RTCScene shared, const Float3* vertices);
  RTCScene empty_scene() const;
  void attach(RTCGeometry geometry);
  std::array<float, 3> corner_tangent(const Placed& placed, std::uint32_t vertex) const;
  void shading_tangents(Hits& hits) const;

  Device device_;
  std::vector<SceneHandle> shared_scenes_;
  std::vector<std::vector<Float3>> normals_;  ///< Those that were mapped.
  SceneHandle scene_;
  std::vector<Placed> placed_;
  Planes planes_;
  bool tangents_ = false, interpolated_ = false;  ///< Whether any object asks for them.
  bool passed_ = false;                           ///< Rays may leave out what they have passed.
};

}  // namespace metamer::cpu
