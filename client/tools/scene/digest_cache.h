#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>

#include "common/scene/files.h"

namespace metamer::client {

/// Digests of files that were read before, so that a scene that is checked again reads nothing that
/// has not changed. A file is the same as before when its path, device, inode, size, and times of
/// modification and of change of its inode (ns) are. As git does with its index, an entry is
/// trusted only if the file was at rest when it was read: its times lay more than `settled` before,
/// or a change within one tick of the file system's clock could keep them. One thread.
class DigestCache {
 public:
  using Now = std::function<std::chrono::nanoseconds()>;  ///< Since 1970, as files' times are.

  /// Keeps at most `capacity` entries, those that were asked for last.
  explicit DigestCache(std::size_t capacity = 10'000, Now now = system_now);

  /// Size and SHA-256 of a file, which is read if there is need to. Errors: those of digest_file.
  Result<FileDigest> digest(const std::filesystem::path& file, std::uint64_t limit);

  std::size_t size() const { return entries_.size(); }
  std::uint64_t files_read() const { return files_read_; }  ///< Since the beginning.

  /// FAT counts times in 2 s, ext3 and some network file systems in 1 s.
  static constexpr std::chrono::seconds settled{2};

  static std::chrono::nanoseconds system_now();

 private:
  /// What tells a file from all others and from itself at another time.
  struct Stamp {
    std::uint64_t device = 0, inode = 0, size = 0;
    std::chrono::nanoseconds modified{0}, changed{0};
    bool operator==(const Stamp&) const = default;
  };
  struct Entry {
    Stamp stamp;
    FileDigest digest;
    std::uint64_t used = 0;  ///< The call that asked for it last.
  };

  static bool stamp_of(const std::filesystem::path& file, Stamp& stamp);
  void keep(const std::filesystem::path& file, const Stamp& stamp, const FileDigest& digest);

  std::size_t capacity_;
  Now now_;
  std::map<std::filesystem::path, Entry> entries_;
  std::uint64_t calls_ = 0, files_read_ = 0;
};

}  // namespace metamer::client
