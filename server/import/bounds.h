#pragma once

#include <cstdint>

/// What the reader of files of so many bytes may take. A format's own text is at most some ten
/// times shorter than what it describes; more is a file that was made to be more.
namespace metamer::import {

/// Of address space that it writes to, and of the arrays that it hands over, in bytes each.
constexpr std::uint64_t max_memory(std::uint64_t bytes) { return (512u << 20) + 32 * bytes; }

/// Until it is ended. The slowest format is read at 20 MB/s.
constexpr std::uint64_t max_seconds(std::uint64_t bytes) { return 30 + bytes / 1'000'000; }

}  // namespace metamer::import
