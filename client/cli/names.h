#pragma once

namespace metamer::client {}

/// A subcommand is made of what every client has.
namespace metamer::cli {
using namespace client;
}
