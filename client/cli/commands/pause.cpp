#include "client/cli/commands/control.h"

namespace metamer::cli {

Command commands::pause() {
  return control_command<&Session::pause>("pause", "stop a job and keep what it rendered");
}

}  // namespace metamer::cli
