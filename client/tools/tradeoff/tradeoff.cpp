#include "client/tools/tradeoff/tradeoff.h"

#include <algorithm>
#include <limits>

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
