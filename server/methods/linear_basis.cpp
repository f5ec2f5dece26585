#include "server/methods/linear_basis.h"

#include <Eigen/SVD>
#include <algorithm>
#include <limits>

namespace metamer {

Eigen::VectorXd LinearBasis::project(const Eigen::VectorXd& spectrum) const {
  return functions.transpose() * spectrum.cwiseProduct(inner);
}

Eigen::MatrixXd LinearBasis::reflect(const Eigen::VectorXd& reflectance) const {
  return functions.transpose() * reflectance.cwiseProduct(inner).asDiagonal() * functions;
}

LinearBasis make_basis(const Eigen::MatrixXd& spectra, const Eigen::VectorXd& inner,
                       Eigen::Index count) {
  // In the coordinates √w Φ the inner product is the plain one.
  const Eigen::VectorXd root = inner.cwiseSqrt();
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(root.asDiagonal() * spectra, Eigen::ComputeThinU);
  LinearBasis basis{{}, inner, svd.singularValues(), 1, 0};

  // What is next to nothing beside the largest is rounding.
  const double largest = basis.singular_values.size() > 0 ? basis.singular_values[0] : 0;
  const double least = largest * std::numeric_limits<double>::epsilon() *
                       static_cast<double>(std::max(spectra.rows(), spectra.cols()));
  Eigen::Index used = 0;
  while (used < std::min(count, basis.singular_values.size()) &&
         basis.singular_values[used] > least)
    ++used;

  // Where w is 0 a function means nothing, and is 0.
  const Eigen::VectorXd back =
      root.unaryExpr([](double value) { return value > 0 ? 1 / value : 0; });
  basis.functions = back.asDiagonal() * svd.matrixU().leftCols(used);
  if (used > 0) basis.condition = largest / basis.singular_values[used - 1];
  const double power = basis.singular_values.squaredNorm();
  if (power > 0)
    basis.residual =
        basis.singular_values.tail(basis.singular_values.size() - used).squaredNorm() / power;
  return basis;
}

}  // namespace metamer
