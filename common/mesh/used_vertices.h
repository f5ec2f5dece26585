#pragma once

#include "common/mesh/mesh_file.h"

namespace metamer {

/// Leaves of a file's vertices those that its triangles use, in their order.
void keep_used_vertices(MeshFile& file);

/// Makes one vertex of those at one place, where a file repeats vertices for each triangle, as
/// those of formats without an index do, and gives them nothing besides.
void join_repeated_vertices(MeshFile& file);

}  // namespace metamer
