#include "client/cli/commands.h"
#include "client/cli/control.h"

namespace metamer::cli {

ExitCode resume(const ControlOptions& options) { return control(options, &Session::resume); }

}  // namespace metamer::cli
