#pragma once

#include "common/models/reflection.h"
#include "server/cpu/lanes.h"

namespace metamer::cpu {

/// A cosine as models want it: 0 behind the surface, and not above 1 by rounding.
inline Float8 cosine(Float8 value) { return min(max(value, Float8{}), metamer::broadcast(1)); }

/// The tangent, or `across` where the tangent is within 3° of the normal and would have no steady
/// direction in the surface: at the poles of a ball, or all over a face that the x axis pierces.
inline Vec8 steady_tangent(const Vec8& normal, const Vec8& tangent, const Vec8& across) {
  const Float8 along = dot(normal, tangent);
  const Int8 parallel = along * along > 0.9973f * dot(tangent, tangent) * dot(normal, normal);
  return select(parallel, across, tangent);
}

/// Which of the angles that cost something a scene's models look at.
struct NeededAngles {
  bool azimuth = false, tangent = false;
};

/// The angles of unit vectors; `tangent` need be neither unit nor orthogonal to the normal, and
/// where it has no part across the normal any direction takes its place. As angles_between
/// (common/models/reference.h) in f32.
inline models::Angles<Float8> angles_of(const Vec8& normal, const Vec8& tangent,
                                        const Vec8& to_light, const Vec8& to_viewer,
                                        Float8 solid_angle, NeededAngles needed) {
  const Vec8 half = normalize(to_light + to_viewer);
  const Float8 j = dot(normal, to_light), k = dot(normal, to_viewer), h = dot(normal, half);
  models::Angles<Float8> angles{.n_dot_l = cosine(j),
                                .n_dot_v = cosine(k),
                                .n_dot_h = cosine(h),
                                .v_dot_h = cosine(dot(to_viewer, half)),
                                .r_dot_v = cosine(2.0f * j * k - dot(to_light, to_viewer)),
                                .azimuth = {},
                                .tangent = metamer::broadcast(1),
                                .solid_angle = solid_angle};
  if (needed.azimuth) {
    const Vec8 light = to_light - normal * j, viewer = to_viewer - normal * k;
    const Float8 across = sqrt(dot(light, light) * dot(viewer, viewer));
    const Float8 ratio = dot(light, viewer) / across;
    angles.azimuth = select(
        across > 0.0f, min(max(ratio, metamer::broadcast(-1)), metamer::broadcast(1)), Float8{});
  }
  if (needed.tangent) {
    // Compare in the surface's plane; both T and H lose their part along the normal.
    const Vec8 projected = half - normal * h;
    const Vec8 flat = tangent - normal * dot(normal, tangent);
    const Float8 size = dot(projected, projected) * dot(flat, flat);
    const Float8 along = dot(projected, flat);
    angles.tangent = select(size > 0.0f, min(along * along / size, metamer::broadcast(1)),
                            metamer::broadcast(1));
  }
  return angles;
}

}  // namespace metamer::cpu
