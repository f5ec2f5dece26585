#pragma once

#include <array>
#include <cmath>

#include "metamer/v1/scene.pb.h"
#include "server/cpu/lanes.h"

/// Where on a triangle the interpolating kinds of shading (2.3) evaluate the model, and how much of
/// each place a point of the triangle sees.
namespace metamer::cpu {

/// A triangle's corners in the world; normals and tangents of any length.
struct Corners {
  std::array<std::array<float, 3>, 3> position, normal, tangent;
  std::array<float, 3> across;  ///< Takes a tangent's place where that is along the normal.
};

inline constexpr int max_places = 6;

/// One place a lane: the centroid; three corners; or the corners 0 1 2 and the middles of the edges
/// 01, 02, 12. Lanes beyond `count` repeat the first place.
struct TrianglePlaces {
  Vec8 position, normal, tangent;  ///< Normals unit, on the side of `side`.
  int count;
};
TrianglePlaces triangle_places(v1::Shading shading, const Corners& corners,
                               const std::array<float, 3>& side);

/// What a point 1 − u − v, u, v (barycentric) sees of each place; they sum to 1. Those of QUADRATIC
/// are the only quadratic functions that are 1 at one place and 0 at the others, so the sum is
/// E[2.3-1] with the coefficients E[2.3-2]; between its corners they may be negative.
std::array<Float8, max_places> place_weights(v1::Shading shading, Float8 u, Float8 v);

}  // namespace metamer::cpu
