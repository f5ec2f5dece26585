#pragma once

#include <atomic>
#include <vector>

#include "common/problem.h"
#include "common/scene/validate.h"
#include "metamer/v1/scene.pb.h"
#include "server/scene/mesh_import.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// Builds the flat scene: validates the message again (clients may lie), resolves names, loads each
/// spectrum once and reads each mesh file once, by `meshes`. Errors: everything that is wrong, each
/// with its field path. `cancelled` is looked at between assets; the result is then an empty list
/// of problems. `skies`: who reads an environment's picture; nobody: it is read from the assets.
tl::expected<RenderScene, std::vector<Problem>> compile_scene(
    const v1::Scene& scene, const AssetReader& assets, const MeshImport& meshes,
    const TextureImport& textures, const std::atomic<bool>& cancelled, const SkyImport& skies = {});

/// The same without objects and meshes: all that changes while those stay as they are. The objects
/// of the message have to be those of the scene that it is for.
tl::expected<RenderScene, std::vector<Problem>> compile_appearance(const v1::Scene& scene,
                                                                   const AssetReader& assets,
                                                                   const TextureImport& textures,
                                                                   const SkyImport& skies = {});

/// The camera of a message that validate_scene has nothing against.
RenderCamera compile_camera(const v1::Camera& camera);

}  // namespace metamer
