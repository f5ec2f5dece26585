#pragma once

#include <Eigen/Core>

namespace metamer {

/// Basis functions that are orthonormal in the inner product ⟨f, g⟩ = Σ f g w, E[3.3-2] with the
/// cell widths (and, if wanted, an observer's sensitivity) in w.
struct LinearBasis {
  Eigen::MatrixXd functions;        ///< A column each; as many as asked for, at most the rank.
  Eigen::VectorXd inner;            ///< w, not negative.
  Eigen::VectorXd singular_values;  ///< Of all the spectra, falling.
  double condition;                 ///< The largest singular value by the last one used.
  double residual;  ///< E[3.3-10] by Σ ⟨Φ, Φ⟩: the share of power that is lost.

  /// Coefficients, E[3.3-3].
  Eigen::VectorXd project(const Eigen::VectorXd& spectrum) const;
  /// R_ji = Σ R E_i E_j w, E[3.3-6]: what a reflectance does to coefficients.
  Eigen::MatrixXd reflect(const Eigen::VectorXd& reflectance) const;
};

/// The best `count` functions for the columns of `spectra`, by their singular value decomposition
/// (3.3.1). Spectra that are 0 everywhere count for nothing; of no power at all, no function is
/// left.
LinearBasis make_basis(const Eigen::MatrixXd& spectra, const Eigen::VectorXd& inner,
                       Eigen::Index count);

/// The same from Σ Φ Φᵀ over all spectra Φ, a row and a column a wavelength: as cheap however many
/// they are. Singular values below 3e-7 of the largest are lost; f32 would not show them.
LinearBasis make_basis_of_products(const Eigen::MatrixXd& products, const Eigen::VectorXd& inner,
                                   Eigen::Index count);

}  // namespace metamer
