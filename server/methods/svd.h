#pragma once

#include <Eigen/Core>

namespace metamer {

/// A = U S Vᵀ, without V: left singular vectors as columns, and values, falling.
struct Svd {
  Eigen::MatrixXd u;
  Eigen::VectorXd values;
};

/// In a file of its own, as nothing here takes longer to compile.
Svd thin_svd(const Eigen::MatrixXd& matrix);

}  // namespace metamer
