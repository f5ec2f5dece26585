#pragma once

#include <Eigen/Geometry>
#include <array>
#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

namespace metamer::gl {

/// A hierarchy of boxes around primitives, as shaders/stages/shadow.glsl walks it: nodes in the
/// order of a walk that enters every box.
struct Boxes {
  std::vector<std::array<std::uint32_t, 4>> low;   ///< Bits of x y z; 0, or 1 + first · 8 + count.
  std::vector<std::array<std::uint32_t, 4>> high;  ///< Bits of x y z; the node behind its part.
  std::vector<std::uint32_t> primitives;           ///< Names, in the order of the leaves.
};

struct BoxedPrimitive {
  Eigen::AlignedBox3f box;
  std::uint32_t name;
};

/// Built by Embree. Nothing when `cancelled` becomes true.
std::optional<Boxes> build_boxes(const std::vector<BoxedPrimitive>& primitives,
                                 const std::atomic<bool>& cancelled);

}  // namespace metamer::gl
