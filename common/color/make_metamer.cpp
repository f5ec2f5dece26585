#include <ClpSimplex.hpp>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "common/color/metamerism.h"

namespace metamer {
namespace {

constexpr Eigen::Index cosines = 11;
constexpr double least_difference = 1e-3;
constexpr int most_steps = 20;
constexpr int most_exchanges = 10'000;

using Rows = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// X Y Z of reflectances as a matrix.
Rows to_rows(const ObserverWeights& weights) {
  Rows rows(3, static_cast<Eigen::Index>(weights.weights[0].size()));
  for (Eigen::Index c = 0; c < 3; ++c)
    rows.row(c) = Eigen::Map<const Eigen::RowVectorXd>(
        weights.weights[static_cast<std::size_t>(c)].data(), rows.cols());
  return rows;
}

Xyz to_array(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

/// Smooth functions that nobody sees under a light: a column each, orthonormal in their
/// coefficients.
Eigen::MatrixXd blacks(const Rows& lit, const std::vector<double>& nm) {
  Eigen::MatrixXd smooth(static_cast<Eigen::Index>(nm.size()), cosines);
  for (Eigen::Index i = 0; i < smooth.rows(); ++i)
    for (Eigen::Index k = 0; k < cosines; ++k) {
      const double phase =
          (nm[static_cast<std::size_t>(i)] - nm.front()) / (nm.back() - nm.front());
      smooth(i, k) = std::cos(std::numbers::pi * static_cast<double>(k) * phase);
    }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(lit * smooth, Eigen::ComputeFullV);
  return smooth * svd.matrixV().rightCols(cosines - svd.rank());
}

/// All that may be added to an original: sums of blacks that leave it in 0..1. COIN-OR Clp finds
/// its vertices, and starts each time from the last one. One thread at a time.
class Polytope {
 public:
  Polytope(const Eigen::MatrixXd& black, const Eigen::VectorXd& original) : black_(black) {
    const auto rows = static_cast<int>(black.rows()), columns = static_cast<int>(black.cols());
    std::vector<CoinBigIndex> starts;
    std::vector<int> indices;
    for (int j = 0; j <= columns; ++j) starts.push_back(j * rows);
    for (int j = 0; j < columns; ++j)
      for (int i = 0; i < rows; ++i) indices.push_back(i);
    const std::vector<double> any(static_cast<std::size_t>(columns), -COIN_DBL_MAX);
    const Eigen::VectorXd least = -original, most = 1 - original.array();
    clp_.setLogLevel(0);
    // Any sum of blacks keeps X Y Z; what leaves 0..1 is cut off at the end, and may not count. All
    // numbers are of the order of 1: scaled by Clp, they would hold less closely.
    clp_.setPrimalTolerance(1e-12);
    clp_.scaling(0);
    clp_.setMaximumIterations(most_exchanges);
    clp_.setOptimizationDirection(-1);
    clp_.loadProblem(columns, rows, starts.data(), indices.data(), black_.data(), any.data(),
                     nullptr, nullptr, least.data(), most.data());
  }

  /// Where goal · (the amount of each black) is largest; nothing where Clp finds no such vertex.
  std::optional<Eigen::VectorXd> outermost(const Eigen::RowVectorXd& goal) {
    for (int j = 0; j < goal.size(); ++j) clp_.setObjectiveCoefficient(j, goal[j]);
    // Where many bounds meet, as at 0 of a black, primal() can go round in circles.
    clp_.dual();
    if (!clp_.isProvenOptimal()) return std::nullopt;
    return black_ * Eigen::Map<const Eigen::VectorXd>(clp_.getColSolution(), black_.cols());
  }

 private:
  const Eigen::MatrixXd& black_;
  ClpSimplex clp_;
};

/// The original under the other light, and the metamers' way from it.
struct Target {
  Rows lit;
  Xyz white;
  Lab lab;
  Eigen::VectorXd original;

  Eigen::Vector3d seen(const Eigen::VectorXd& added) const { return lit * (original + added); }
  double difference(const Eigen::Vector3d& xyz) const {
    return delta_e_00(lab, to_lab(to_array(xyz), white));
  }
};

/// By how much X, Y and Z raise `value` at `xyz`; steps of a millionth of the white.
template <class Function>
Eigen::Vector3d gradient(const Eigen::Vector3d& xyz, const Function& value) {
  Eigen::Vector3d result;
  for (Eigen::Index c = 0; c < 3; ++c) {
    const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(c);
    result[c] = (value(xyz + step) - value(xyz - step)) / 2e-6;
  }
  return result;
}

/// Vertices of the set of metamers that lie outermost in 26 directions of L*a*b*, then by climbing
/// from the farthest of them: ΔE00 rises to the next vertex until it does not.
Eigen::VectorXd farthest(const Target& target, const Eigen::MatrixXd& black) {
  Polytope metamers(black, target.original);
  Eigen::VectorXd best = Eigen::VectorXd::Zero(black.rows());
  double difference = 0;
  const auto consider = [&](const Eigen::Vector3d& direction) {
    const auto added = metamers.outermost(direction.transpose() * target.lit * black);
    const double other = added ? target.difference(target.seen(*added)) : 0;
    if (!(other > difference)) return false;
    best = *added;
    difference = other;
    return true;
  };
  const Eigen::Vector3d start = target.seen(best);
  for (int i = 0; i < 27; ++i) {
    const Eigen::Vector3d way(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    if (way.isZero()) continue;
    consider(gradient(start, [&](const Eigen::Vector3d& xyz) {
      const Lab lab = to_lab(to_array(xyz), target.white);
      return way.dot(Eigen::Vector3d(lab.l, lab.a, lab.b));
    }));
  }
  for (int step = 0; step < most_steps; ++step) {
    const Eigen::Vector3d uphill = gradient(
        target.seen(best), [&](const Eigen::Vector3d& xyz) { return target.difference(xyz); });
    if (!consider(uphill)) break;
  }
  return best;
}

}  // namespace

Result<Metamer> make_metamer(const Spectrum& original, const Spectrum& under,
                             const Spectrum& against, const Observer& observer) {
  for (std::size_t i = 0; i < original.nm.size(); ++i)
    if (original.values[i] < 0 || original.values[i] > 1)
      return problem("a reflectance lies in 0..1 (at " + number_text(original.nm[i]) +
                     " nm it is " + number_text(original.values[i]) + ")");

  // Put everything at 1 nm.
  const Wavelengths wavelengths = observer_wavelengths();
  const auto lit_by = [&](const Spectrum& light) {
    return to_rows(under_light(observer, light, wavelengths.nm()));
  };
  const Rows here = lit_by(under), there = lit_by(against);
  const Eigen::Vector3d white = there.rowwise().sum();
  if (!(here.rowwise().sum().minCoeff() > 0) || !(white.minCoeff() > 0))
    return problem("both lights must have a white to see");
  const std::vector<double> values = resample(original, wavelengths.nm(), Outside::hold).values;
  const Eigen::VectorXd start =
      Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));

  // Add what is black under the one light and far away under the other.
  const Target target{.lit = there,
                      .white = to_array(white),
                      .lab = to_lab(to_array(there * start), to_array(white)),
                      .original = start};
  const Eigen::VectorXd found = start + farthest(target, blacks(here, wavelengths.nm()));
  Metamer result{.reflectance = {.nm = wavelengths.nm(), .values = {}},
                 .de00 = target.difference(there * found)};
  if (!(result.de00 >= least_difference))
    return problem("no smooth reflectance in 0..1 matches it there and differs from it elsewhere");
  // Clp keeps to 0..1 within 1e-12: the rest is cut off.
  for (const double value : found) result.reflectance.values.push_back(std::clamp(value, 0.0, 1.0));
  return result;
}

}  // namespace metamer
