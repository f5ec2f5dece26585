#pragma once

#include <atomic>

#include "server/gl/buffer.h"
#include "server/gl/program.h"
#include "server/scene/render_scene.h"

namespace metamer::gl {

/// A scene's objects in the memory of the GPU, every object in camera space (instances too): what
/// shaders/stages/geometry.glsl, surface.glsl and shadow.glsl read. Needs a current Context.
class Geometry {
 public:
  /// `scene` in camera space (to_camera_space). Errors: what this device's buffers do not hold.
  /// An empty message: `cancelled` became true.
  static Result<Geometry> upload(const RenderScene& scene, const std::atomic<bool>& cancelled);

  void bind() const;
  /// All triangles by one program and all spheres by the other, into the current framebuffer.
  void draw(const Program& triangles, const Program& spheres) const;
  std::uint32_t triangle_count() const { return triangle_count_; }
  std::uint32_t node_count() const { return node_count_; }
  bool has_tangents() const { return has_tangents_; }

 private:
  Geometry() = default;

  Buffer positions_, corners_, objects_, boxes_, low_, high_, primitives_, normals_, tangents_,
      owners_;
  std::uint32_t triangle_count_ = 0, sphere_count_ = 0, node_count_ = 0;
  bool has_tangents_ = false;
};

}  // namespace metamer::gl
