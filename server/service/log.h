#pragma once

#include <string>

namespace metamer::service {

/// Logs go to stderr from now on, from `level` ("info") upwards. Whatever a message cites, a
/// client's words or a file's name, it stays one line and commands no terminal: see printable().
void log_to_stderr(const std::string& level);

}  // namespace metamer::service
