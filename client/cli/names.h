#pragma once

namespace metamer::client {}

/// A subcommand is made of what every client has, so that each file of the room would begin with a
/// list of the same names.
namespace metamer::cli {
using namespace client;  // NOLINT(google-build-using-namespace)
}
