#include "client/cli/commands.h"
#include "client/cli/commands/bench/bench_run.h"

namespace metamer::cli {
namespace {

ExitCode run_models(const BenchOptions& options) { return compare_cases(options, model_cases()); }

}  // namespace

Command commands::bench_models() {
  return make_command<BenchOptions>("bench models",
                                    "the time of one scene with each model, next to Blinn–Phong's",
                                    declare_bench, run_models);
}

}  // namespace metamer::cli
