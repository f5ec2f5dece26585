#pragma once

#include <string>

#include "client/tools/tradeoff/tradeoff.h"

namespace metamer::client {

/// A row of a method without parameters that took so long, a quarter of it for its tables.
inline TradeoffRow row(const std::string& name, double seconds, double error) {
  TradeoffRow one;
  one.what.method = name;
  one.what.stem = name;
  one.prepare = seconds / 4;
  one.render = seconds - seconds / 4;
  one.error.percentile_95 = error;
  one.error.maximum = 2 * error;
  one.error.count = 1;
  return one;
}

}  // namespace metamer::client
