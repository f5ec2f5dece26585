#pragma once

#include "common/mesh/mesh_file.h"

namespace metamer {

/// Reads the polygons of an OBJ (Wavefront's Appendix B1): v, vt, vn, f, o, g, usemtl.
Result<MeshFile> read_obj(const Bytes& bytes, const std::string& name);

}  // namespace metamer
