#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/color/error_statistics.h"
#include "common/color/xyz.h"
#include "metamer/v1/plan.pb.h"
#include "metamer/v1/scene.pb.h"

/// What every method costs on a scene, and how far it is off.
namespace metamer::client {

/// One method with its parameters.
struct TradeoffCase {
  std::string method;      ///< "linear"
  std::string parameters;  ///< "4 bases, observer"; empty: it has none.
  std::string stem;        ///< Of file names: "linear-4-observer".
  v1::Method settings;
};

/// What a case came to: the cheapest of its rounds, and its difference (ΔE00) from the reference.
struct TradeoffRow {
  TradeoffCase what;
  std::string failure;  ///< Why there is nothing else; empty: it rendered.
  double prepare = 0;   ///< Seconds, of the round with the smallest sum.
  double render = 0;    ///< Seconds.
  ErrorStatistics error;
  bool front = false;  ///< No other is both cheaper and more accurate.

  double seconds() const { return prepare + render; }
};

/// All that a run found.
struct Tradeoff {
  std::string scene;
  v1::Plan plan;               ///< Of the reference.
  Xyz white{};                 ///< Of the differences.
  bool white_of_plan = false;  ///< Else that of D65 stands in: the plan has none.
  unsigned rounds = 0;
  double reference_seconds = 0;
  std::vector<TradeoffRow> rows;
};

/// What the others are measured against: exact, which counts what spectra say between whole
/// nanometres.
v1::Method tradeoff_reference();
/// Every method over its parameters; the naive rgb comes first.
std::vector<TradeoffCase> tradeoff_cases();

/// Of as many costs and errors, which are on the Pareto front: ordered by cost, each of it has a
/// smaller error than all that are cheaper.
std::vector<bool> pareto_front(std::span<const double> costs, std::span<const double> errors);
/// Marks that of the rows that rendered, by seconds and the 95th percentile.
void mark_front(std::vector<TradeoffRow>& rows);

/// Seconds that the naive rgb took; nothing where it failed or took none.
std::optional<double> rgb_seconds(const Tradeoff& tradeoff);

/// RFC 4180, UTF-8, a line a row; numbers read back as the same doubles.
std::string tradeoff_csv(const Tradeoff& tradeoff);

}  // namespace metamer::client
