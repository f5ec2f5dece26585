#pragma once

#include <cstdint>

#include "server/gl/camera.h"
#include "server/gl/geometry.h"
#include "server/gl/programs.h"
#include "server/gl/target.h"
#include "server/methods/direct_tables.h"
#include "server/render/renderer.h"

namespace metamer::gl {

/// `point` as the source had to do it, E[4.2-1]: four wavelengths of everything are drawn and
/// evaluated at a time, and a pass after each adds them to X Y Z. For comparison. Needs a current
/// Context.
class MultiPass {
 public:
  /// `tables` of a method with bands; so many lights.
  static Result<MultiPass> create(const DirectTables& tables, std::uint32_t lights);

  /// Draws one sample of the region's pixels and adds it to the colours in binding 13. What each
  /// pixel sees is in texture unit 0, and all that shaders/stages/shade.comp.glsl reads is bound.
  /// `places` are the lobes at triangles' places, where there are any. Leaves the rest out when
  /// `cancelled`.
  Result<void> run(const Programs& programs, const Geometry& geometry, const Buffer& places,
                   const RegionView& view, SamplePoint place, const Control& control);

 private:
  MultiPass() = default;

  std::uint32_t groups_ = 0, lights_ = 0;
  Buffer light_values_, observer_;
  Target target_;
};

}  // namespace metamer::gl
