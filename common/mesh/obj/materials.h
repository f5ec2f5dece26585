#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/mesh/triangle_mesh.h"

/// What an OBJ says of its materials: in files of its own, .mtl (Wavefront, "Advanced Visualizer
/// Manual", Appendix B2).
namespace metamer {

inline constexpr std::size_t max_mtl = 16u << 20;   ///< Bytes: a hundred thousand materials.
inline constexpr std::size_t max_mtl_files = 16;    ///< Of one OBJ.
inline constexpr std::size_t max_mtl_names = 4096;  ///< Materials of a file that are read.

/// What follows each mtllib of an OBJ, as it stands there: one file's name, or several with blanks
/// between; each once, at most max_mtl_files. UTF-8.
std::vector<std::string> mtl_names(std::string_view obj);

struct MtlMaterial {
  std::string name;                 ///< UTF-8.
  std::optional<Double3> diffuse;   ///< Kd; finite.
  std::optional<Double3> specular;  ///< Ks; finite.
  std::optional<double> exponent;   ///< Ns; finite.
  bool shows_highlight = true;      ///< illum is not 0 or 1.
  bool is_textured = false;         ///< map_Kd
  std::vector<std::string> left_out =
      {};  ///< Its other statements that count: "d", "Ke", each once.
};

struct MtlFile {
  std::vector<MtlMaterial> materials;  ///< By their names, the first of each.
  std::vector<std::string> notes;      ///< Lines that can't be read, names given twice.
};

/// Reads all of a .mtl that can be read; `text` has at most max_mtl bytes.
MtlFile read_mtl(std::string_view text);

}  // namespace metamer
