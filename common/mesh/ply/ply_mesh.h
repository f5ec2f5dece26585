#pragma once

#include "common/mesh/mesh_file.h"

namespace metamer {

/// Reads PLY (Turk 1994; ascii, and binary of both byte orders): x y z, nx ny nz, s t or u v, and
/// faces or tristrips by vertex_indices or vertex_index, wherever they stand; everything else is
/// passed over. Positions that are not f32 or narrower are f64. A normal or UV that is not finite
/// is none.
Result<MeshFile> read_ply(const Bytes& bytes, const std::string& name);

}  // namespace metamer
