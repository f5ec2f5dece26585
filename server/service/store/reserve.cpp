#include "server/service/store/reserve.h"

#include <system_error>

#include "server/service/store/durable_file.h"

namespace metamer::service {

namespace {

namespace fs = std::filesystem;

/// The tables' pages that a change of users touches, of 4 KiB, and the log's index of 32 KiB: four
/// times that.
constexpr std::uint64_t reserve_bytes = 256u << 10;

fs::path reserve_of(const fs::path& state) { return state / "reserve"; }

}  // namespace

void keep_reserve(const fs::path& state) {
  const fs::path file = reserve_of(state);
  std::error_code ignored;
  if (fs::exists(file, ignored)) return;
  try {
    write_zeros(file, reserve_bytes);
  } catch (const std::system_error&) {
    fs::remove(file, ignored);
  }
}

bool give_up_reserve(const fs::path& state) {
  std::error_code ignored;
  return fs::remove(reserve_of(state), ignored);
}

}  // namespace metamer::service
