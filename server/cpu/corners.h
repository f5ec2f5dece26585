#pragma once

#include <array>

namespace metamer::cpu {

/// A triangle's corners in the world; normals and tangents of any length.
struct Corners {
  std::array<std::array<float, 3>, 3> position, normal, tangent;
  std::array<float, 3> across;  ///< Takes a tangent's place where that is along the normal.
};

/// Where on a texture's surface a point lies.
struct SurfaceUv {
  float u, v;
  float density;  ///< Of UVs: the root of their area over that of the surface, 1/length.
};

/// How a surface lies along its UVs.
struct SurfaceAxes {
  std::array<float, 3> u, v;  ///< Of a unit of each, in the world; 0: they have no direction there.
  bool mirrored;              ///< Its map has turned what Embree takes for its front to the back.
};

}  // namespace metamer::cpu
