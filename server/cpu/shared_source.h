#pragma once

#include <cstring>

#include "common/lights/registry.h"
#include "common/models/reflection.h"
#include "server/cpu/lanes.h"

// No file uses all of them, and no light all that it is given.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"

/// The sources in shaders/ that see vectors, for a packet of points at a time: Real is a number of
/// each, and a number that they name is the same in every lane. Each file that includes this has
/// them to itself, so that they are inlined into its loops.
namespace metamer::cpu::shared {
namespace {
using Real = Floats;
using Vec3 = Vectors;
using Bool = Ints;
using Angles = models::Angles<Floats>;
using Lobes = models::Lobes<Floats>;
#define Real(number) metamer::broadcast(static_cast<float>(number))
// Each after what it calls.
// clang-format off
#include "shaders/surface/vectors.glsl"
#include "shaders/surface/angles.glsl"
#include "shaders/surface/lift.glsl"
#include "shaders/surface/places.glsl"
#include "shaders/fresnel/schlick.glsl"
#include "shaders/fresnel/fold.glsl"
#include "common/lights/shared_source.inc"
// clang-format on
#undef Real
}  // namespace
}  // namespace metamer::cpu::shared

#pragma GCC diagnostic pop
