#include "client/tools/scene/digest_cache.h"

#include <sys/stat.h>

#include <algorithm>
#include <utility>

namespace metamer::client {
namespace {

namespace fs = std::filesystem;
using std::chrono::nanoseconds;

nanoseconds to_duration(const timespec& time) {
  return std::chrono::seconds(time.tv_sec) + nanoseconds(time.tv_nsec);
}

}  // namespace

DigestCache::DigestCache(std::size_t capacity, Now now)
    : capacity_(std::max<std::size_t>(capacity, 1)), now_(std::move(now)) {}

nanoseconds DigestCache::system_now() {
  return std::chrono::system_clock::now().time_since_epoch();
}

bool DigestCache::stamp_of(const fs::path& file, Stamp& stamp) {
  struct stat status {};
  if (stat(file.c_str(), &status) != 0) return false;
  stamp = {.device = status.st_dev,
           .inode = status.st_ino,
           .size = static_cast<std::uint64_t>(status.st_size),
           .modified = to_duration(status.st_mtim),
           .changed = to_duration(status.st_ctim)};
  return true;
}

Result<FileDigest> DigestCache::digest(const fs::path& file, std::uint64_t limit) {
  ++calls_;
  Stamp before, after;
  const bool known = stamp_of(file, before);
  const auto found = entries_.find(file);
  if (known && found != entries_.end() && found->second.stamp == before && before.size <= limit) {
    found->second.used = calls_;
    return found->second.digest;
  }

  // Read it; what was written meanwhile, or may be written yet without a trace, is not kept.
  if (found != entries_.end()) entries_.erase(found);
  const nanoseconds begun = now_();
  ++files_read_;
  Result<FileDigest> digest = digest_file(file, limit);
  const bool at_rest = std::max(before.modified, before.changed) + settled < begun;
  if (digest && known && at_rest && stamp_of(file, after) && after == before &&
      digest->size == before.size)
    keep(file, before, *digest);
  return digest;
}

void DigestCache::keep(const fs::path& file, const Stamp& stamp, const FileDigest& digest) {
  if (entries_.size() >= capacity_) {
    const auto oldest = std::min_element(
        entries_.begin(), entries_.end(),
        [](const auto& a, const auto& b) { return a.second.used < b.second.used; });
    entries_.erase(oldest);
  }
  entries_[file] = {stamp, digest, calls_};
}

}  // namespace metamer::client
