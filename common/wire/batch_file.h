#pragma once

#include <cstddef>
#include <filesystem>

#include "common/problem.h"
#include "metamer/v1/batch.pb.h"

/// The files by which metamerd and the tasks of a cluster talk (batch.proto).
namespace metamer::wire {

/// Bytes of such a file: a task ends once it has a quarter of it, with the tiles under way.
inline constexpr std::size_t max_batch_file = 256u << 20;

// Writes a file that appears whole or not at all: beside its place, synced, then renamed, and the
// folder synced. Errors: the system's, and nothing is left behind; a message that is too large.
Result<void> write_batch_file(const std::filesystem::path& file, const v1::BatchOrder& order);
Result<void> write_batch_file(const std::filesystem::path& file, const v1::BatchResult& result);

// Reads one. Errors: the system's; too large; other bytes than were written.
Result<v1::BatchOrder> read_batch_order(const std::filesystem::path& file);
Result<v1::BatchResult> read_batch_result(const std::filesystem::path& file);

}  // namespace metamer::wire
