#pragma once

namespace metamer::service {

/// `metamerd user add|list|revoke`, beginning with "user": changes or prints the table of users in
/// the folder of a daemon's state, whether or not that daemon runs. Prints a new token, once, on
/// stdout; problems go to stderr. Gives the exit code.
int run_user_command(int argc, const char* const* argv);

}  // namespace metamer::service
