#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/mesh_file.h"

namespace metamer {

/// For each vertex the number of the first one at its place. Empty: no two are at one place. 0 and
/// -0 are one place.
std::vector<std::uint32_t> equal_positions(const MeshFile& mesh);

}  // namespace metamer
