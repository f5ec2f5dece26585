#include "common/color/linear_programme.h"

#include <Eigen/LU>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

namespace metamer {
namespace {

using Eigen::Index;

/// What counts as 0 of numbers of the order of 1.
constexpr double epsilon = 1e-11;
/// Exchanges without gain before Bland's rule, which is slow.
constexpr int patience = 1000;

/// basic = values − table · (the others), goal = slope · (the others) + …; the others are 0.
/// Variables 0 … n − 1 are x, the rest the slack of each limit, which may not fall below 0.
struct Simplex {
  Eigen::MatrixXd table;
  Eigen::VectorXd values, slope;
  std::vector<Index> basic, others;

  bool is_free(Index variable) const { return variable < table.cols(); }

  /// Another variable whose change raises the goal: the one that raises it fastest, or, by Bland's
  /// rule, the one of the least number. −1: there is none.
  Index entering(bool by_number) const {
    Index found = -1;
    double steepest = 0;
    for (Index j = 0; j < table.cols(); ++j) {
      const Index variable = others[static_cast<std::size_t>(j)];
      const double gain = is_free(variable) ? std::abs(slope[j]) : slope[j];
      if (gain <= epsilon) continue;
      const bool better = by_number
                              ? found < 0 || variable < others[static_cast<std::size_t>(found)]
                              : gain > steepest;
      if (!better) continue;
      found = j;
      steepest = gain;
    }
    return found;
  }

  /// The limit that stops it first, of those the one of the least number. −1: none does.
  Index leaving(Index column) const {
    const double sign = slope[column] > 0 ? 1 : -1;
    double nearest = std::numeric_limits<double>::infinity();
    Index found = -1;
    for (Index i = 0; i < table.rows(); ++i) {
      const Index variable = basic[static_cast<std::size_t>(i)];
      const double fall = sign * table(i, column);
      if (is_free(variable) || fall <= epsilon) continue;
      const double way = values[i] / fall;
      const bool same = found >= 0 && std::abs(way - nearest) <= epsilon;
      if (same ? variable < basic[static_cast<std::size_t>(found)] : way < nearest) {
        nearest = way;
        found = i;
      }
    }
    return found;
  }

  void exchange(Index row, Index column) {
    const double pivot = table(row, column);
    const Eigen::RowVectorXd across = table.row(row) / pivot;
    const Eigen::VectorXd down = table.col(column);
    const double moved = values[row] / pivot, gain = slope[column];
    table -= down * across;
    values -= down * moved;
    slope -= gain * across.transpose();
    table.col(column) = -down / pivot;
    slope[column] = -gain / pivot;
    table.row(row) = across;
    table(row, column) = 1 / pivot;
    values[row] = moved;
    std::swap(basic[static_cast<std::size_t>(row)], others[static_cast<std::size_t>(column)]);
  }
};

}  // namespace

std::optional<Eigen::VectorXd> maximise(const Eigen::VectorXd& goal, const Eigen::MatrixXd& limits,
                                        const Eigen::VectorXd& bounds) {
  assert(limits.rows() == bounds.size() && limits.cols() == goal.size());
  assert((bounds.array() >= 0).all());
  Simplex simplex{.table = limits, .values = bounds, .slope = goal, .basic = {}, .others = {}};
  for (Index j = 0; j < goal.size(); ++j) simplex.others.push_back(j);
  for (Index i = 0; i < bounds.size(); ++i) simplex.basic.push_back(goal.size() + i);

  // Where many limits meet, exchanges gain nothing; only Bland's rule surely comes out of that.
  int idle = 0;
  for (;;) {
    const Index column = simplex.entering(idle > patience);
    if (column < 0) break;
    const Index row = simplex.leaving(column);
    if (row < 0) return std::nullopt;
    idle = simplex.values[row] > epsilon ? 0 : idle + 1;
    simplex.exchange(row, column);
  }

  // The exchanges have lost digits: meet the limits that hold there, once and directly.
  Eigen::MatrixXd met = Eigen::MatrixXd::Zero(goal.size(), goal.size());
  Eigen::VectorXd at = Eigen::VectorXd::Zero(goal.size());
  for (Index j = 0; j < goal.size(); ++j) {
    const Index variable = simplex.others[static_cast<std::size_t>(j)];
    if (simplex.is_free(variable)) {
      met(j, variable) = 1;
    } else {
      met.row(j) = limits.row(variable - goal.size());
      at[j] = bounds[variable - goal.size()];
    }
  }
  return met.fullPivLu().solve(at);
}

}  // namespace metamer
