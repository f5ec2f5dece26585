// A subcommand that adds its numbers up, and says so.
#include <numeric>

#include "client/cli/commands.h"
#include "client/cli/report.h"
#include "client/cli/shared_options.h"

namespace metamer::cli {
namespace {

struct ToyOptions {
  bool json = false;
  std::vector<std::uint32_t> numbers;
};

ExitCode run(const ToyOptions& options) {
  Report report(options.json);
  const auto sum = std::accumulate(options.numbers.begin(), options.numbers.end(), 0u);
  report.document()["sum"] = sum;
  report.line(std::to_string(sum));
  return report.finish(ExitCode::done);
}

void declare(ToyOptions& values, Options& options) {
  options.push_back({.names = "numbers",
                     .target = &values.numbers,
                     .meaning = "what is added",
                     .required = true,
                     .range = {{0, 100}}});
  declare_json(values.json, options);
}

}  // namespace

Command commands::toy() { return make_command<ToyOptions>("toy", "add numbers up", declare, run); }

}  // namespace metamer::cli
