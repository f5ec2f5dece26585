#pragma once

#include "server/cpu/packet.h"
#include "server/scene/render_scene.h"

namespace metamer::cpu {

/// A thin lens around the eye: all rays through one place of the plane in focus are one place of
/// the picture (R. L. Cook, T. Porter and L. Carpenter, "Distributed Ray Tracing", Computer
/// Graphics 18(3), 1984). Its points are the fixed pattern's.
class Lens {
 public:
  explicit Lens(const RenderCamera& camera);  ///< Whose aperture is above 0.

  /// Rays from points of the lens in place of those from the eye. `way`: where a ray through the
  /// eye goes, of length 1 along the view. By the packet's seeds and samples.
  void put_rays(const Vectors& way, Packet& packet) const;

 private:
  float radius_, per_focus_;  ///< per_focus_: 1 / distance of what is in focus.
  Vectors right_, up_;
};

}  // namespace metamer::cpu
