#include <array>
#include <cstdio>

#include "client/cli/bench_run.h"
#include "client/cli/commands.h"
#include "client/cli/overrides.h"

namespace metamer::cli {
namespace {

void print_rows(const std::vector<BenchCase>& cases, const std::vector<Measured>& measured,
                Report& report) {
  std::array<char, 160> text{};
  Json& rows = report.document()["cases"];
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double ratio = median(relative(measured[i], measured[0]));
    const double share = median(measured[i].models), seconds = median(measured[i].seconds);
    std::snprintf(text.data(), text.size(), "%-32s %10.3f %6.1f %% %8.3f", cases[i].name.c_str(),
                  ratio, 100 * share, seconds);
    report.line(text.data());
    rows.push_back(
        {{"name", cases[i].name}, {"relative", ratio}, {"models", share}, {"seconds", seconds}});
  }
}

ExitCode bench(const BenchOptions& options, std::vector<BenchCase> cases) {
  BenchTable table;
  table.legend =
      "Relative to " + cases[0].name + "; models: the share of the rendering that evaluates them.";
  std::array<char, 160> head{};
  std::snprintf(head.data(), head.size(), "%-32s %10s %8s %8s", "case", "relative", "models",
                "seconds");
  table.head = head.data();
  table.print = print_rows;
  return run_bench(options, {std::move(cases)}, table);
}

}  // namespace

ExitCode bench_models(const BenchOptions& options) { return bench(options, model_cases()); }

ExitCode bench_methods(const BenchOptions& options) {
  if (choose_a_method(options.overrides))
    return refuse_bench(options,
                        "bench methods runs every method: options that choose one are not for it");
  return bench(options, method_cases(options.overrides.backend == "gl"));
}

}  // namespace metamer::cli
