#include "client/cli/commands.h"

namespace metamer::cli {

Command commands::mesh() { return {.name = "mesh", .meaning = "explain mesh files"}; }

}  // namespace metamer::cli
