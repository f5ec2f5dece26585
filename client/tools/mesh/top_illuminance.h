#pragma once

#include <vector>

#include "common/mesh/gltf/gltf_scene.h"

/// How bright a glTF's lights make its surfaces.
namespace metamer::client {

/// E of a plane that faces the light, in lux: I / d² of points and of spots on their axis,
/// `nearest` metres away at least.
double illuminance_at(const GltfLight& light, const Double3& place, double nearest);

/// What the illuminance by all lights, in lux, does not exceed on 99.9 % of a mesh's area, on the
/// brighter side of each surface; nothing throws shadows. Of points that lie evenly on the area. 0:
/// it has no area, or no light falls on it.
double top_illuminance(const MeshFile& mesh, const std::vector<GltfLight>& lights);

}  // namespace metamer::client
