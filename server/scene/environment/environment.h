#pragma once

#include "common/problem.h"
#include "common/scene/validate.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// Adds the lights of an environment, which stands at `field`, RenderScene::environment, and what
/// its file was taken for. `emission` is the light's own spectrum, among the scene's; a sky by day
/// has none. A picture is
/// scaled so that a perfect white facing +y, which sees all of the upper half, has Y = 1, and
/// becomes a light for each value of a pixel: those of red, green and blue (reflectance_of_rgb), or
/// of each band, times the own spectrum.
/// Their luminances add up to the light's. Errors, with their field: those of read_sky_picture(), a
/// picture that does not shine from above the horizon.
Result<void> add_environment(const v1::Light& light, const std::string& field,
                             std::uint32_t emission, const SkyImport& skies, RenderScene& scene);

}  // namespace metamer
