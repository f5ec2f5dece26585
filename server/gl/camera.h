#pragma once

#include "server/film/film.h"
#include "server/film/sample_pattern.h"
#include "server/gl/program.h"
#include "server/scene/render_scene.h"

namespace metamer::gl {

/// A region of a picture as its camera sees it: the uniforms of shaders/stages/camera.glsl.
struct RegionView {
  const RenderCamera& camera;
  std::uint32_t width, height;  ///< Of the picture, in pixels.
  Rect region;

  /// For the sample at this place of each pixel.
  void set(const Program& program, SamplePoint place) const;
};

}  // namespace metamer::gl
