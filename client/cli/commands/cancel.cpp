#include "client/cli/commands/control.h"

namespace metamer::cli {

Command commands::cancel() {
  return control_command<&Session::cancel>("cancel", "end a job and drop what it rendered");
}

}  // namespace metamer::cli
