#pragma once

#include "server/cpu/soft/surface_light.h"

namespace metamer::cpu::soft {

/// An object as a light: a parallelogram of two triangles as a quad, a sphere as one, everything
/// else pointwise. `light` is one of the scene's that is an object; the scene must outlive it.
SurfaceLight object_light(const RenderScene& scene, const RenderLight& light);

}  // namespace metamer::cpu::soft
