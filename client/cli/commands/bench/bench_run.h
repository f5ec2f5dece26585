#pragma once

#include <functional>
#include <string>
#include <vector>

#include "client/cli/commands/bench/bench_cases.h"
#include "client/cli/exit_code.h"
#include "client/cli/report.h"
#include "client/cli/shared_options.h"

namespace metamer::cli {

struct BenchOptions {
  CommonOptions common;
  Overrides overrides;
  std::uint32_t rounds = 5;
};

void declare_bench(BenchOptions& bench, Options& options);

/// What one case took, a round each.
struct Measured {
  std::vector<double> seconds;  ///< Rendering alone.
  std::vector<double> models;   ///< The share of it that went into models, 0..1.
};

double median(std::vector<double> values);

/// The times of each round relative to another case's in the same round: what else the machine
/// does then slows both.
std::vector<double> relative(const Measured& one, const Measured& base);

/// The table of a benchmark.
struct BenchTable {
  std::string legend;
  std::string head;
  /// Prints a group's lines, and keeps them for --json.
  std::function<void(const std::vector<BenchCase>&, const std::vector<Measured>&, Report&)> print;
};

/// Says why the options make no sense for a benchmark.
ExitCode refuse_bench(const BenchOptions& options, const std::string& why);

/// Renders all cases, with the options in place of their settings, group by group, and prints what
/// the scene is, the legend and the table, each group as soon as it is measured. The rounds of a
/// group interleave its cases, after one sample a pixel of each that warms the worker up.
ExitCode run_bench(const BenchOptions& options, std::vector<std::vector<BenchCase>> groups,
                   const BenchTable& table);

/// The same of one group, with a line for each case: its time relative to the first one's.
ExitCode compare_cases(const BenchOptions& options, std::vector<BenchCase> cases);

}  // namespace metamer::cli
