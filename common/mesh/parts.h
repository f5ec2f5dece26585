#pragma once

#include "common/mesh/mesh_file.h"

namespace metamer {

/// Leaves of a file the pieces of one object, of one material, or of "object/material", and the
/// vertices that they use. Errors: no piece is called so (the names that are there); the name is an
/// object's and another's material's.
Result<void> select_part(MeshFile& file, const std::string& part);

}  // namespace metamer
