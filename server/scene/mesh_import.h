#pragma once

#include <string>

#include "common/problem.h"
#include "common/scene/validate.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// Reads PLY, OBJ or glTF 2.0 (by the extension of `name`) through Assimp, all meshes of the file
/// joined into one in the file's own coordinates. Files that the file names in turn (a .gltf's
/// buffers) come from `assets` too: nothing is opened by path. Errors: a format that can't be read,
/// no triangles, a vertex or normal that is not finite or too far out, too many triangles.
/// `tangents`: also these, from the UVs, as far as there are any.
/// Only for the worker: importers are not safe against hostile files.
Result<TriangleMesh> import_mesh(const std::string& name, const AssetReader& assets,
                                 bool tangents = false);

}  // namespace metamer
