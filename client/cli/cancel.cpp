#include "client/cli/commands.h"
#include "client/cli/control.h"

namespace metamer::cli {

ExitCode cancel(const ControlOptions& options) { return control(options, &Session::cancel); }

}  // namespace metamer::cli
