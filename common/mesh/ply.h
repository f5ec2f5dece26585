#pragma once

#include "common/mesh/mesh_file.h"

namespace metamer {

/// Reads PLY (Turk 1994; ascii, and binary of both byte orders): x y z, nx ny nz, s t or u v, and
/// faces by vertex_indices or vertex_index. Faces of more than three corners become fans.
Result<MeshFile> read_ply(const Bytes& bytes, const std::string& name);

}  // namespace metamer
