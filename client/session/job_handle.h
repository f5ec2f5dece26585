#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

#include "client/session/error.h"
#include "common/problem.h"

namespace metamer::client {

/// What a job is known by: its number, and the server that gave it.
struct JobHandle {
  std::uint64_t number = 0;  ///< 0: of no job.
  /// Welcome.server_id in hex, small letters, or its first digits; empty: not said, or of a server
  /// that keeps no jobs, whose numbers come from the clock.
  std::string server = {};

  std::strong_ordering operator<=>(const JobHandle&) const = default;
};

/// Digits of a server's id that are written, and that have to be there: of 2^32 servers one other
/// has the same.
inline constexpr std::size_t handle_digits = 8, least_handle_digits = 6;

/// Reads "7@3f9c2a1b", with 6 to 32 digits, or "7". Error: it is neither.
Result<JobHandle> parse_job_handle(std::string_view text);
/// "7@3f9c2a1b", or "7" where the server has no id: for people to paste.
std::string to_text(const JobHandle& job);

/// Welcome.server_id in hex; empty: it has none.
std::string server_digits(const v1::Welcome& welcome);
/// Whether the job is this server's: its number alone would find another's. Error: input.
Answer<void> check_server(const JobHandle& job, const v1::Welcome& welcome);

}  // namespace metamer::client
