#pragma once

#include "common/mesh/mesh_file.h"

namespace metamer {

/// Reads the triangles of a glTF 2.0's scene (.gltf or .glb; Khronos, "glTF 2.0 Specification"):
/// nodes, instances (EXT_mesh_gpu_instancing), quantised and sparse accessors, morph targets by
/// their default weights. An unknown extension that the file requires is an error.
Result<MeshFile> read_gltf(const Bytes& bytes, const std::string& name, const MeshBytes& files);

}  // namespace metamer
