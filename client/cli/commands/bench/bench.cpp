#include "client/cli/commands.h"

namespace metamer::cli {

Command commands::bench() {
  return {.name = "bench", .meaning = "measure a server; prints ratios of one run"};
}

}  // namespace metamer::cli
