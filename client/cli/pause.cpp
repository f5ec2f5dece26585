#include "client/cli/commands.h"
#include "client/cli/control.h"

namespace metamer::cli {

ExitCode pause(const ControlOptions& options) { return control(options, &Session::pause); }

}  // namespace metamer::cli
