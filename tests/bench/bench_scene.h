#pragma once

#include "metamer/v1/plan.pb.h"
#include "server/scene/render_scene.h"

namespace metamer::bench {

/// A rippled ground of `2 * side * side` triangles with interpolated normals, seen from above under
/// two point lights; eight materials in stripes, measured spectra (the CRI test colours), half of
/// them with Blinn–Phong highlights. `mirrors`: every second stripe also mirrors.
RenderScene make_ground(unsigned side, bool mirrors);

/// One thread, 320 × 240, `spp` samples a pixel; the method is still to be set.
v1::Plan make_plan(const RenderScene& scene, unsigned spp);

/// `samples` point samples, evenly over 400 to 700 nm.
v1::Method point_method(unsigned samples);
v1::Method rgb_method();

}  // namespace metamer::bench
