#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "metamer/v1/batch.pb.h"
#include "server/service/executors/tile_ranges.h"

namespace metamer::service {

// The files of tasks, in a folder that all nodes see. Whoever calls these waits for its disk, which
// may be another machine's: not the service's thread.

/// What a task has left.
struct FoundResult {
  std::filesystem::path folder;  ///< Of its job,
  std::uint64_t attempt = 0;     ///< and the number in the file's name.
  v1::BatchResult message;       ///< Without its tiles, which are these, and their digest:
  RangeResult range;
  std::string damage;  ///< Why the file can't be believed; empty: it is whole.
};

/// Where the attempt's task is to leave its result.
std::filesystem::path result_file(const std::filesystem::path& folder, std::uint64_t attempt);

/// Makes `folder`, which nobody else can enter, with "0.order" and so on. Errors: the system's.
Result<void> write_orders(const std::filesystem::path& folder,
                          const std::vector<v1::BatchOrder>& orders);
/// Writes the bytes of a picture for a task. Errors: the system's.
Result<void> write_picture(const std::filesystem::path& file, const std::string& bytes);

/// Takes the results that lie in these folders, and removes them; what is beyond 64 MiB stays for
/// the next call.
std::vector<FoundResult> take_results(const std::vector<std::filesystem::path>& folders);

/// The last line of what a task has said, as others may be shown it; empty: it has said nothing.
std::string last_words(const std::filesystem::path& log);

/// Removes what is in `folder` under names that begin so: what an earlier server has left.
void remove_leavings(const std::filesystem::path& folder, const std::string& prefix);

}  // namespace metamer::service
