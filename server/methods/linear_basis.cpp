#include "server/methods/linear_basis.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/methods/svd.h"

namespace metamer {

Eigen::VectorXd LinearBasis::project(const Eigen::VectorXd& spectrum) const {
  return functions.transpose() * spectrum.cwiseProduct(inner);
}

Eigen::MatrixXd LinearBasis::reflect(const Eigen::VectorXd& reflectance) const {
  return functions.transpose() * reflectance.cwiseProduct(inner).asDiagonal() * functions;
}

namespace {

/// Few columns L with L Lᵀ = `products`, by Cholesky's elimination with the largest rest as pivot,
/// down to a rest of 1e-13 of the largest: what is left is rounding. At least one, of zeros.
Eigen::MatrixXd factor(const Eigen::MatrixXd& products) {
  const Eigen::Index most = products.rows();
  Eigen::VectorXd rest = products.diagonal();
  const double least = 1e-13 * rest.maxCoeff();
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(most, most);
  Eigen::Index count = 0;
  for (Eigen::Index pivot; count < most && rest.maxCoeff(&pivot) > least; ++count) {
    auto column = columns.col(count);
    column = products.col(pivot);
    column.noalias() -= columns.leftCols(count) * columns.row(pivot).head(count).transpose();
    column /= std::sqrt(rest[pivot]);
    rest -= column.cwiseAbs2();
    rest[pivot] = 0;
  }
  return columns.leftCols(std::max<Eigen::Index>(count, 1));
}

/// In the coordinates √w Φ, where the inner product is the plain one.
LinearBasis basis_of(const Eigen::MatrixXd& weighted, const Eigen::VectorXd& inner,
                     Eigen::Index count) {
  const Svd svd = thin_svd(weighted);
  LinearBasis basis{{}, inner, svd.values, 1, 0};

  // What is next to nothing beside the largest is rounding.
  const double largest = basis.singular_values.size() > 0 ? basis.singular_values[0] : 0;
  const double least = largest * std::numeric_limits<double>::epsilon() *
                       static_cast<double>(std::max(weighted.rows(), weighted.cols()));
  Eigen::Index used = 0;
  while (used < std::min(count, basis.singular_values.size()) &&
         basis.singular_values[used] > least)
    ++used;

  // Where w is 0 a function means nothing, and is 0.
  const Eigen::VectorXd back =
      inner.unaryExpr([](double value) { return value > 0 ? 1 / std::sqrt(value) : 0; });
  basis.functions = back.asDiagonal() * svd.u.leftCols(used);
  if (used > 0) basis.condition = largest / basis.singular_values[used - 1];
  const double power = basis.singular_values.squaredNorm();
  if (power > 0)
    basis.residual =
        basis.singular_values.tail(basis.singular_values.size() - used).squaredNorm() / power;
  return basis;
}

}  // namespace

LinearBasis make_basis(const Eigen::MatrixXd& spectra, const Eigen::VectorXd& inner,
                       Eigen::Index count) {
  return basis_of(inner.cwiseSqrt().asDiagonal() * spectra, inner, count);
}

LinearBasis make_basis_of_products(const Eigen::MatrixXd& products, const Eigen::VectorXd& inner,
                                   Eigen::Index count) {
  const Eigen::VectorXd root = inner.cwiseSqrt();
  return basis_of(factor(root.asDiagonal() * products * root.asDiagonal()), inner, count);
}

}  // namespace metamer
