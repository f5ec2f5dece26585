#pragma once

#include <vector>

#include "common/mesh/obj/piece.h"

namespace metamer::obj {

/// A vertex as corners name it.
struct Corner {
  std::uint32_t v, vt, vn;
  bool operator==(const Corner&) const = default;
};

/// The different corners of all faces, in the order of their first use; the faces' `v` become their
/// numbers.
std::vector<Corner> join_corners(std::vector<Faces>& pieces, std::size_t positions);

}  // namespace metamer::obj
