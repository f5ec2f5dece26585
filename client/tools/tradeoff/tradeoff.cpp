#include "client/tools/tradeoff/tradeoff.h"

#include <algorithm>
#include <limits>

#include "common/spectral/wavelengths.h"

namespace metamer::client {
namespace {

v1::Method uniform(double from, double to, double step) {
  v1::Method method;
  v1::Point& point = *method.mutable_point();
  point.set_from(from);
  point.set_to(to);
  point.set_step(step);
  return method;
}

TradeoffCase linear(unsigned bases, bool observer) {
  const std::string count = std::to_string(bases);
  TradeoffCase one{.method = "linear",
                   .parameters = count + " bases" + (observer ? ", observer" : ""),
                   .stem = "linear-" + count + (observer ? "-observer" : ""),
                   .settings = {}};
  v1::Linear& settings = *one.settings.mutable_linear();
  settings.set_bases(bases);
  settings.set_weighting(observer ? v1::Linear::OBSERVER : v1::Linear::NONE);
  return one;
}

}  // namespace

v1::Method tradeoff_reference() { return uniform(observer_from_nm, observer_to_nm, 1); }

std::vector<TradeoffCase> tradeoff_cases() {
  std::vector<TradeoffCase> cases(3);
  cases[0] = {.method = "rgb", .parameters = "", .stem = "rgb", .settings = {}};
  cases[0].settings.mutable_rgb();
  cases[1] = {.method = "prefilter", .parameters = "", .stem = "prefilter", .settings = {}};
  cases[1].settings.mutable_prefilter();
  cases[2] = {.method = "exact", .parameters = "", .stem = "exact", .settings = {}};
  cases[2].settings.mutable_exact();
  for (const unsigned bases : {2u, 3u, 4u, 5u, 6u, 8u, 12u, 16u})
    for (const bool observer : {false, true}) cases.push_back(linear(bases, observer));
  for (const double step : {50.0, 20.0, 10.0, 5.0, 1.0}) {
    const std::string count = std::to_string(static_cast<int>(300 / step) + 1);
    cases.push_back({.method = "point",
                     .parameters = count + " uniform",
                     .stem = "point-" + count,
                     .settings = uniform(400, 700, step)});
  }
  for (const unsigned count : {4u, 6u, 8u, 12u, 16u}) {
    cases.push_back({.method = "point",
                     .parameters = std::to_string(count) + " fitted",
                     .stem = "point-fitted-" + std::to_string(count),
                     .settings = {}});
    cases.back().settings.mutable_point()->set_fitted(count);
  }
  return cases;
}

void mark_front(std::vector<TradeoffRow>& rows) {
  std::vector<TradeoffRow*> good;
  for (TradeoffRow& row : rows) {
    row.front = false;
    if (row.failure.empty()) good.push_back(&row);
  }
  std::stable_sort(good.begin(), good.end(), [](const TradeoffRow* a, const TradeoffRow* b) {
    if (a->seconds() != b->seconds()) return a->seconds() < b->seconds();
    return a->error.percentile_95 < b->error.percentile_95;
  });
  double best = std::numeric_limits<double>::infinity();
  for (TradeoffRow* row : good) {
    row->front = row->error.percentile_95 < best;
    best = std::min(best, row->error.percentile_95);
  }
}

std::optional<double> rgb_seconds(const Tradeoff& tradeoff) {
  for (const TradeoffRow& row : tradeoff.rows)
    if (row.what.method == "rgb" && row.failure.empty() && row.seconds() > 0) return row.seconds();
  return std::nullopt;
}

}  // namespace metamer::client
