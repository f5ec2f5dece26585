#pragma once

#include <spdlog/common.h>

#include <cstdint>
#include <string>

namespace metamer::service {

/// What a line of the log is about, beside its message. Empty and 0: not said.
struct LogFields {
  std::string peer = {};  ///< "uid 1000", "192.0.2.7"
  std::string user = {};
  std::uint64_t job = 0;
  std::string reason = {};
};

enum class LogFormat {
  text,  ///< `[time] [metamerd] [info] message user=ann job=7 reason="killed by signal 9"`
  json,  ///< One object a line: time, level, message, and those fields that are said.
};

/// Logs go to stderr from now on, from `level` ("info") upwards. Whatever a message or a field
/// cites, a client's words or a file's name, it stays one line and commands no terminal: see
/// printable(). Text that goes to systemd's journal has no time, which that adds, but a priority,
/// which it reads.
void log_to_stderr(const std::string& level, LogFormat format = LogFormat::text);

/// A line with fields.
void log_line(spdlog::level::level_enum level, const LogFields& fields, const std::string& message);

}  // namespace metamer::service
