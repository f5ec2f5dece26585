#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/mesh/triangle_mesh.h"
#include "common/problem.h"

namespace metamer::obj {

inline constexpr std::uint32_t none = 0xFFFFFFFF;

/// How many v, vt and vn there are, and lines.
struct Counts {
  std::uint64_t v = 0, vt = 0, vn = 0;
  int lines = 0;
};

/// Faces in a row that bear the same names.
struct Run {
  /// As far as they are named before it; nothing: as in the run before. An o ends its group.
  std::optional<std::string> object, group, material;
  std::optional<std::uint32_t> smoothing;  ///< Its group; 0: off. The same of it.
  std::size_t first_face = 0, first_corner = 0;
  std::uint64_t triangles = 0;  ///< That its faces may become.
};

/// The faces of a piece of a file. Corners are numbers of v, vt and vn in the file, from 0.
struct Faces {
  std::vector<std::uint32_t> corners;    ///< Of each face, how many.
  std::vector<std::uint32_t> v, vt, vn;  ///< Of each corner; vt, vn empty: the file has none.
  std::vector<Run> runs;
  bool free_form = false;        ///< It has curves or surfaces, which are none.
  bool points_or_lines = false;  ///< It has p or l, which are none.
  bool vertex_colors = false;    ///< A v has r g b behind its x y z.
};

/// Where v, vt and vn go, in the file's order.
struct Vertices {
  std::vector<Double3> v;
  std::vector<Float2> vt;
  std::vector<Float3> vn;  ///< Unit, or 0.
};

Counts count(std::string_view piece, char line_end);

/// Reads a piece, which `before` it stands behind, into its part of `vertices` and into `faces`.
/// Errors, by line: a v that is not finite or too far out, an index out of range.
std::optional<Problem> read_piece(std::string_view piece, char line_end, const Counts& before,
                                  const std::string& file, Vertices& vertices, Faces& faces);

}  // namespace metamer::obj
