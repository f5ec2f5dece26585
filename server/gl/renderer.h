#pragma once

#include <memory>

#include "server/gl/device.h"
#include "server/render/renderer.h"

namespace metamer::gl {

/// Rasteriser and compute shaders of this device, which must outlive it. Probes trace on so many
/// threads of the CPU.
std::unique_ptr<Backend> make_backend(Device& device, unsigned threads);

/// What they have.
inline constexpr Features features = Features::all().without(
    {Feature::mirrors, Feature::factors, Feature::textures, Feature::area_lights,
     Feature::environment, Feature::planes, Feature::transmission, Feature::lens,
     Feature::inter_reflection, Feature::normal_maps, Feature::alpha});

}  // namespace metamer::gl
