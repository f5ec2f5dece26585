#pragma once

#include "common/mesh/mesh_file.h"

namespace metamer {

/// Reads the polygons of an OBJ (Wavefront, "Advanced Visualizer Manual", Appendix B1): v, vt, vn,
/// f, o, g, s, usemtl. A piece is named by its group, where it is in none by its object. Positions
/// are f64 where f32 would lose their last digits: see needs_f64(). A normal or UV that is not
/// finite is none. Faces before any s are smoothed with each other. Surfaces that are no polygons
/// are left out, with a note. `bytes` are let go as early as can be.
Result<MeshFile> read_obj(Bytes bytes, const std::string& name);

}  // namespace metamer
