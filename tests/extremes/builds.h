#pragma once

#include <vector>

#include "tests/extremes/table.h"

/// The builds of the shared sources that the truth table judges, and how far each may be from it.
namespace metamer::extremes {

/// The files of the table.
inline constexpr const char* files[] = {"models",         "slopes",         "attenuations",
                                        "diffuse",        "fresnel",        "ripples",
                                        "vectors/models", "vectors/slopes", "vectors/attenuations",
                                        "vectors/diffuse"};

enum class Build { f64, f32, glsl };

struct Bound {
  const char* name;
  double relative, of_peak;  ///< An error is within one of them.
  double smallest, largest;  ///< The normal numbers of its type.
};
/// From vectors it is wider than from cosines: their angles are rounded before a model sees them.
Bound bound(Build build, const Row& row);

/// What the build makes of each row: as many values as the row has, or none where the row's inputs
/// don't fit the build's type. For Build::glsl see gl_build.h.
using Values = std::vector<std::vector<double>>;
Values evaluate_f64(const std::vector<Row>& rows);
Values evaluate_f32(const std::vector<Row>& rows);

struct Error {
  /// Of f64 and from vectors relative; of f32 relative or of the peak, the smaller; of GLSL of the
  /// peak.
  double size = 0;
  bool within = true;  ///< The bound.
};

/// The worst of a row's values. Where the true value is no normal number the build's must not be
/// one either, and that difference counts as none.
Error compare(const Row& row, const std::vector<double>& values, const Bound& bound);

}  // namespace metamer::extremes
