#pragma once

#include <Eigen/Geometry>
#include <memory>

#include "server/cpu/lanes.h"
#include "server/scene/render_scene.h"

namespace metamer::cpu::soft {

/// Light from some point of a light: what shaders/lights/incident.glsl has of a place. The weight
/// is that of the light's luminance, of a perfect white that faces it: L Ω / π of a point that
/// stands for the solid angle Ω.
struct Samples {
  Vectors direction;
  Floats reach, weight;
};

/// Of the way to a light: a surface in which it lies does not hide it (incident.glsl).
inline constexpr float reached = 0.9999F;

/// A surface of luminance 1 of which each lane is sampled by itself. Immutable, shared by threads.
class PointwiseLight {
 public:
  virtual ~PointwiseLight() = default;

  /// What lights a place.
  struct Found {
    Eigen::Vector3d direction;  ///< Unit.
    double distance, weight;    ///< As Samples has them; a weight of 0: nothing.
  };
  /// By the point u, v of a pattern. `own`: the primitive that the place lies in; -1: none.
  virtual Found find(const Eigen::Vector3d& at, double u, double v, int own) const = 0;
};

/// A mesh's triangles by their areas, each in front of its corners' turn: there even in solid angle
/// (J. Arvo, "Stratified Sampling of Spherical Triangles", SIGGRAPH 1995) where it is close by,
/// else in area. `object` shines (find_shining); both must outlive it.
std::shared_ptr<const PointwiseLight> make_mesh_light(const RenderObject& object,
                                                      const TriangleMesh& mesh);

/// The unit sphere under a map, seen from outside: as a sphere's light is sampled before the map,
/// whose Jacobian for directions is |det A| / |A d|³.
std::shared_ptr<const PointwiseLight> make_ellipsoid_light(const Eigen::Affine3d& to_world);

}  // namespace metamer::cpu::soft
