#include "client/tools/tradeoff/tradeoff.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "common/scene/methods.h"
#include "common/scene/settings.h"

namespace metamer::client {
namespace {

TradeoffCase case_of(const v1::Method& method) {
  TradeoffCase one{.method = method_entry(method)->word,
                   .parameters = "",
                   .stem = method_entry(method)->word,
                   .settings = method};
  if (method.has_linear()) {
    const std::string bases = std::to_string(method.linear().bases());
    const bool observer = method.linear().weighting() == v1::Linear::OBSERVER;
    one.parameters = bases + " bases" + (observer ? ", observer" : "");
    one.stem += "-" + bases + (observer ? "-observer" : "");
  }
  if (method.has_point()) {
    const bool fitted = method.point().has_fitted();
    const std::string count = std::to_string(fitted ? method.point().fitted()
                                                    : point_wavelengths(method.point())->size());
    one.parameters = count + (fitted ? " fitted" : " uniform");
    one.stem += (fitted ? "-fitted-" : "-") + count;
  }
  return one;
}

}  // namespace

v1::Method tradeoff_reference() {
  v1::Method method;
  method.mutable_exact();
  return method;
}

std::vector<TradeoffCase> tradeoff_cases() {
  std::vector<TradeoffCase> cases;
  for (const v1::Method& method : compared_methods()) cases.push_back(case_of(method));
  return cases;
}

std::vector<bool> pareto_front(std::span<const double> costs, std::span<const double> errors) {
  std::vector<std::size_t> order(costs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return costs[a] != costs[b] ? costs[a] < costs[b] : errors[a] < errors[b];
  });
  std::vector<bool> front(costs.size(), false);
  double best = std::numeric_limits<double>::infinity();
  for (const std::size_t i : order) {
    front[i] = errors[i] < best;
    best = std::min(best, errors[i]);
  }
  return front;
}

void mark_front(std::vector<TradeoffRow>& rows) {
  std::vector<TradeoffRow*> good;
  std::vector<double> costs, errors;
  for (TradeoffRow& row : rows) {
    row.front = false;
    if (!row.failure.empty()) continue;
    good.push_back(&row);
    costs.push_back(row.seconds());
    errors.push_back(row.error.percentile_95);
  }
  const std::vector<bool> front = pareto_front(costs, errors);
  for (std::size_t i = 0; i < good.size(); ++i) good[i]->front = front[i];
}

std::optional<double> rgb_seconds(const Tradeoff& tradeoff) {
  for (const TradeoffRow& row : tradeoff.rows)
    if (row.what.method == "rgb" && row.failure.empty() && row.seconds() > 0) return row.seconds();
  return std::nullopt;
}

}  // namespace metamer::client
