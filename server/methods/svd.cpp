#include "server/methods/svd.h"

#include <Eigen/SVD>

namespace metamer {

Svd thin_svd(const Eigen::MatrixXd& matrix) {
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeThinU);
  return {svd.matrixU(), svd.singularValues()};
}

}  // namespace metamer
