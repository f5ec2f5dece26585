#pragma once

#include "server/scene/render_scene.h"

namespace metamer {

/// Where in the world a scene is rendered from, and in which unit of length: around this point f32
/// is finest, and Embree multiplies coordinates three deep. A picture then depends neither on where
/// it is taken nor on the unit.
struct CameraSpace {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  double scale = 1;  ///< A power of two.

  /// The scene's own: its eye is the origin, its size between 1 and 2.
  static CameraSpace of(const RenderScene& scene);

  /// Places the scene's objects, lights and camera, all given in the world.
  void place(RenderScene& scene) const;
  void place(RenderLight& light) const;
  void place(RenderMedium& medium) const { medium.thickness *= scale; }
  void place(RenderMap& map) const { map.height *= scale; }
  Eigen::Vector3d to_world(const Eigen::Vector3d& placed) const { return placed / scale + origin; }
  void place(RenderCamera& camera) const {
    camera.eye = scale * (camera.eye - origin);
    camera.aperture_radius *= scale;
    camera.focus_distance *= scale;
  }
};

/// The scene in its own camera space.
RenderScene to_camera_space(RenderScene scene);

}  // namespace metamer
