#pragma once

#include <Eigen/Core>
#include <optional>

namespace metamer {

/// The x, of any sign, that makes goal·x largest where limits · x ≤ bounds, row by row, and all
/// bounds are at least 0, so that x = 0 is allowed. Dantzig's simplex method; where many
/// limits meet, Bland's rule (1977) ends it. Small and dense: a row a limit, a few columns. Nothing
/// where goal·x has no largest value.
std::optional<Eigen::VectorXd> maximise(const Eigen::VectorXd& goal, const Eigen::MatrixXd& limits,
                                        const Eigen::VectorXd& bounds);

}  // namespace metamer
