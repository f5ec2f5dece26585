#pragma once

#include <Eigen/Core>
#include <string>

#include "common/models/reflection.h"

namespace metamer::laws {

/// How much of white light from `to_light` a surface reflects: ∫ρ (N·V)/(π (N·L)) over the
/// directions of the viewer, with C_D = C_S = F = 1. To about 1e-3, however narrow the highlight
/// is.
double hemispherical_reflectance(const models::Reflection<double>& reflection,
                                 const Eigen::Vector3d& to_light);

/// A Markdown table: every model with its defaults, d = s = ½ and s = 1, and the models with facets
/// with each slope, at a few angles of incidence.
std::string reflectance_table();

}  // namespace metamer::laws
