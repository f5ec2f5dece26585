#include "server/methods/fitted.h"

#include <Eigen/QR>
#include <algorithm>

#include "server/methods/banded.h"
#include "server/methods/notices.h"
#include "server/methods/scene_spectra.h"
#include "server/methods/training_set.h"

namespace metamer {
namespace {

using Eigen::Index;

/// Weights are kept from growing against each other by counting each value as uncertain by 1e-5 of
/// itself: what sums in f32, and spectra that are not in the training set, may bring.
constexpr double uncertainty = 1e-10;

/// Candidates are where the observer sees at least this share of what it sees best. Beyond, a
/// spectrum may well tell which of a scene's few paints it is, but no more than that.
constexpr double least_sensitivity = 0.005;

/// The normal equations of one of X, Y and Z, a row a wavelength: gram · weights = target.
struct NormalEquations {
  Eigen::MatrixXd gram;
  Eigen::VectorXd target;
};

NormalEquations normal_equations(const Eigen::MatrixXd& spectra, const TrainingSet& set,
                                 Index axis) {
  const Eigen::VectorXd weights = set.weights.row(axis).transpose();
  const Eigen::MatrixXd weighted = spectra * weights.asDiagonal();
  NormalEquations equations;
  equations.gram = Eigen::MatrixXd::Zero(spectra.rows(), spectra.rows());
  equations.gram.selfadjointView<Eigen::Lower>().rankUpdate(weighted);
  equations.gram.triangularView<Eigen::StrictlyUpper>() = equations.gram.transpose();
  equations.gram.diagonal() *= 1 + uncertainty;
  equations.target = weighted * set.xyz.row(axis).transpose().cwiseProduct(weights);
  return equations;
}

/// Orthogonal least squares (S. Chen, S. A. Billings and W. Luo, International Journal of Control
/// 50, 1873 (1989)) for X, Y and Z at once: after each choice, what every candidate would explain
/// of the errors that are left. A choice is a column of the Gram matrices' Cholesky factors.
class Selection {
 public:
  Selection(const TrainingSet& set, Index most)
      : visible_(set.sensitivity.array() > least_sensitivity * set.sensitivity.maxCoeff()) {
    for (Index axis = 0; axis < 3; ++axis) {
      Axis& own = axes_[static_cast<std::size_t>(axis)];
      own.equations = normal_equations(set.spectra, set, axis);
      own.factor.resize(set.spectra.rows(), most);
    }
    restart();
  }

  /// Nothing is chosen.
  void restart() {
    count_ = 0;
    for (Axis& axis : axes_) {
      axis.rest = visible_.select(axis.equations.gram.diagonal(), 0);
      axis.target = axis.equations.target;
    }
  }

  void choose(Index candidate) {
    for (Axis& axis : axes_) {
      const double pivot = axis.rest[candidate];
      if (!(pivot > 0)) continue;
      auto column = axis.factor.col(count_);
      column = axis.equations.gram.col(candidate);
      column.noalias() -=
          axis.factor.leftCols(count_) * axis.factor.row(candidate).head(count_).transpose();
      column /= std::sqrt(pivot);
      axis.rest -= column.cwiseAbs2();
      axis.target -= axis.target[candidate] / std::sqrt(pivot) * column;
      axis.rest[candidate] = 0;
    }
    ++count_;
  }

  /// The drop of the squared errors' sum, by candidate.
  Eigen::VectorXd gains() const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(axes_[0].rest.size());
    for (const Axis& axis : axes_)
      sum += (axis.rest.array() > 0)
                 .select(axis.target.array().square() / axis.rest.array(), 0)
                 .matrix();
    return sum;
  }

 private:
  struct Axis {
    NormalEquations equations;
    Eigen::MatrixXd factor;  ///< Its first count_ columns.
    Eigen::VectorXd rest;    ///< What the choices leave of the Gram matrix's diagonal,
    Eigen::VectorXd target;  ///< and of the target.
  };
  Eigen::Array<bool, Eigen::Dynamic, 1> visible_;
  std::array<Axis, 3> axes_;
  Index count_ = 0;
};

/// Puts in the place of each choice the best one beside all the others, until nothing gets better
/// or it takes too long: the work of one exchange grows with the square of their number.
void exchange(Selection& selection, std::vector<Index>& chosen) {
  const auto count = chosen.size();
  std::size_t exchanges = 100'000 / (count * count), unchanged = 0;
  for (std::size_t i = 0; unchanged < count && exchanges > 0; i = (i + 1) % count, --exchanges) {
    selection.restart();
    for (std::size_t other = 0; other < count; ++other)
      if (other != i) selection.choose(chosen[other]);
    const Eigen::VectorXd gains = selection.gains();
    Index best;
    const bool better = gains.maxCoeff(&best) > gains[chosen[i]] * (1 + 1e-9);
    unchanged = better ? 1 : unchanged + 1;
    if (better) chosen[i] = best;
  }
}

/// Rows of the training set, rising.
std::vector<Index> choose_rows(const TrainingSet& set, std::size_t most) {
  std::vector<Index> chosen;
  if (set.whites == 0) return chosen;
  Selection selection(set, static_cast<Index>(most));
  const double all = set.weights.cwiseProduct(set.xyz).squaredNorm();
  constexpr double useful = 1e-9;  // its root is 3e-5 of some 200 ΔE from black to a colour
  while (chosen.size() < most) {
    Index best;
    if (!(selection.gains().maxCoeff(&best) > useful * all)) break;
    chosen.push_back(best);
    selection.choose(best);
  }
  if (chosen.size() > 1) exchange(selection, chosen);
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

/// The weights of X, Y and Z, a row each, for the chosen rows: least squares on condition that the
/// first lights keep their own X Y Z.
Eigen::MatrixXd fit_weights(const TrainingSet& set, const std::vector<Index>& chosen) {
  const auto count = static_cast<Index>(chosen.size());
  if (set.whites == 0) return Eigen::MatrixXd::Zero(3, count);
  const Eigen::MatrixXd spectra = set.spectra(chosen, Eigen::all);
  const Index kept = std::min(set.whites, (count + 1) / 2);
  const Eigen::MatrixXd whites = spectra.leftCols(kept);

  Eigen::MatrixXd weights(3, count);
  for (Index axis = 0; axis < 3; ++axis) {
    const NormalEquations equations = normal_equations(spectra, set, axis);
    // Of lines alone, no more wavelengths than those have light: the rest of the matrix is 0.
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> gram(equations.gram);
    const Eigen::VectorXd free = gram.solve(equations.target);
    // Lagrange's multipliers; lights that depend on each other agree in what they ask for.
    const Eigen::MatrixXd reach = gram.solve(whites);
    const Eigen::VectorXd missing =
        set.xyz.row(axis).head(kept).transpose() - whites.transpose() * free;
    const Eigen::MatrixXd multipliers = whites.transpose() * reach;
    weights.row(axis) = free + reach * multipliers.completeOrthogonalDecomposition().solve(missing);
  }
  return weights;
}

std::vector<Index> rows_at(const std::vector<double>& nm) {
  const std::vector<double> all = observer_wavelengths().nm();
  std::vector<Index> rows;
  for (const double one : nm)
    rows.push_back(std::lower_bound(all.begin(), all.end(), one) - all.begin());
  return rows;
}

}  // namespace

std::vector<double> fitted_wavelengths(const RenderScene& scene, const Observer& observer,
                                       std::size_t most) {
  const std::vector<double> all = observer_wavelengths().nm();
  std::vector<double> nm;
  for (const Index row : choose_rows(make_training_set(scene, observer), most))
    nm.push_back(all[static_cast<std::size_t>(row)]);
  if (nm.empty()) nm.push_back(555);  // where nothing is seen, one value is as good as any
  return nm;
}

void plan_fitted(const RenderScene& scene, const v1::Settings& settings, v1::Plan& plan) {
  const v1::Point& point = settings.method().point();
  const auto nm = fitted_wavelengths(scene, scene.observer, point.fitted());
  plan.mutable_wavelength()->Assign(nm.begin(), nm.end());
  plan.set_from(nm.front());
  plan.set_to(nm.back());
  plan_found(nm.size(), point.fitted(), "settings.method.point.fitted", "need", "wavelength", plan);
}

std::unique_ptr<Method> make_fitted(const v1::Plan& plan, const RenderScene& scene) {
  const Observer& choice = scene.observer;
  const std::vector<double> nm =
      plan.wavelength().empty()
          ? fitted_wavelengths(scene, choice, plan.method().point().fitted())
          : std::vector<double>(plan.wavelength().begin(), plan.wavelength().end());
  const std::vector<Index> chosen = rows_at(nm);

  // The weights stand for every nanometre, so a light has its luminance by every nanometre.
  const Wavelengths every = observer_wavelengths();
  const ObserverWeights observer = observer_weights(choice, every);
  LightTables lights(scene, nm.size(), [&](const Spectrum& emission, double luminance) {
    const std::vector<double> power = mean_power(emission, every);
    const double scale = luminance_scale(observer, power, luminance);
    std::vector<double> values;
    for (const Index row : chosen) values.push_back(scale * power[static_cast<std::size_t>(row)]);
    return values;
  });

  FactorRows rows(scene);
  BandTable values(rows.size(), nm.size());
  rows.for_each(scene, nm,
                [&](std::uint32_t row, const std::vector<double>& at) { values.set(row, at); });

  const TrainingSet set = make_training_set(scene, choice);
  const Eigen::MatrixXd weights = fit_weights(set, chosen);
  BandTable xyz(3, nm.size());
  for (std::size_t axis = 0; axis < 3; ++axis)
    xyz.set(axis, to_list(weights.row(static_cast<Index>(axis)).transpose()));
  // Most of it is three products of the training set's columns with themselves.
  const double learned = 1e7 + 4e4 * static_cast<double>(set.spectra.cols());
  return std::make_unique<BandedMethod>(
      std::move(rows), BandedMethod::Tables{std::move(lights), std::move(values), std::move(xyz)},
      learned);
}

}  // namespace metamer
