#pragma once

#include <string>

#include "server/scene/render_scene.h"

namespace metamer::gl {

/// What not every picture needs.
struct Wanted {
  bool places = false;  ///< A shading interpolates over triangles.
  bool passes = false;  ///< MultiPass
};

/// Of a program that draws.
struct RasterSource {
  std::string vertex, fragment;
};

/// The texts of the programs that a renderer runs; empty: not wanted.
struct ProgramSources {
  RasterSource triangles, spheres;  ///< Names of what is seen.
  std::string shade, finish;        ///< For each light.
  std::string places;               ///< For each light.
  RasterSource pass_triangles, pass_spheres;
  std::string combine;
};

/// For the scene's models and no others.
ProgramSources program_sources(const RenderScene& scene, Wanted wanted);

}  // namespace metamer::gl
