#pragma once

#include <cstdint>
#include <vector>

#include "common/mesh/mesh_file.h"

namespace metamer {

/// For each vertex the number of one at its place, the same one for all that are there. Empty: no
/// two are at one place. 0 and -0 are one place.
std::vector<std::uint32_t> equal_positions(const MeshFile& mesh);

}  // namespace metamer
