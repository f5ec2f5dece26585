#include "client/cli/commands/control.h"

namespace metamer::cli {

Command commands::resume() {
  return control_command<&Session::resume>("resume", "go on with a paused job");
}

}  // namespace metamer::cli
