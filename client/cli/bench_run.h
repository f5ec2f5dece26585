#pragma once

#include <functional>
#include <string>
#include <vector>

#include "client/cli/bench_cases.h"
#include "client/cli/exit_code.h"
#include "client/cli/options.h"
#include "client/cli/report.h"

namespace metamer::cli {

/// What one case took, a round each.
struct Measured {
  std::vector<double> seconds;  ///< Rendering alone.
  std::vector<double> models;   ///< The share of it that went into models, 0..1.
};

double median(std::vector<double> values);

/// The times of each round relative to another case's in the same round: what else the machine
/// does then slows both.
std::vector<double> relative(const Measured& one, const Measured& base);

/// Prints what was measured of each case.
using PrintBench = std::function<void(const std::vector<BenchCase>& cases,
                                      const std::vector<Measured>& measured, Report& report)>;

/// Renders all cases, with the options in place of their settings, in rounds that interleave them,
/// after one that warms the worker up; prints what the scene is, the legend and the table.
ExitCode run_bench(const BenchOptions& options, std::vector<BenchCase> cases,
                   const std::string& legend, const PrintBench& print);

}  // namespace metamer::cli
