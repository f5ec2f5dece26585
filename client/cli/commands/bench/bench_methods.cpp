#include "client/cli/commands.h"
#include "client/cli/commands/bench/bench_run.h"
#include "client/cli/overrides.h"

namespace metamer::cli {
namespace {

ExitCode run_methods(const BenchOptions& options) {
  if (choose_a_method(options.overrides))
    return refuse_bench(options,
                        "bench methods runs every method: options that choose one are not for it");
  return compare_cases(options, method_cases(options.overrides.backend == "gl"));
}

}  // namespace

Command commands::bench_methods() {
  return make_command<BenchOptions>("bench methods",
                                    "the time of one scene by each method, next to rgb's",
                                    declare_bench, run_methods);
}

}  // namespace metamer::cli
