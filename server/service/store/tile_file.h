#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/problem.h"

namespace metamer::service {

/// The tiles of one job's picture on the disk, in the order in which they were made:
///
///     8 bytes   "MTMTILE1"
///     records   u32 tile, u32 bytes of xyz, u32 bytes of factors, u32 CRC-32C of all the rest of
///               the record, u64 sequence, u64 rays, f64 seconds; then the bytes. Little-endian.
///
/// Only appended to; what a crash left half written is cut off when it is next opened. The factors
/// of the whole scene are a record of tile `scene`.
class TileFile {
 public:
  static constexpr std::uint32_t scene = 0xffffffff;
  static constexpr std::uint64_t head_bytes = 8;

  struct Entry {
    std::uint32_t tile = 0;
    std::uint64_t sequence = 0;  ///< Of its event.
    std::uint64_t rays = 0;
    double time = 0;           ///< Of its event: seconds since the job was submitted.
    std::uint64_t offset = 0;  ///< Of the record.
    std::uint32_t xyz_bytes = 0;
    std::uint32_t factor_bytes = 0;
  };
  struct Contents {
    std::string xyz;
    std::string factors;
  };

  /// Neither makes nor opens it.
  explicit TileFile(std::filesystem::path path) : path_(std::move(path)) {}
  ~TileFile();
  TileFile(const TileFile&) = delete;
  TileFile& operator=(const TileFile&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Keeps it readable though its name may go: with a descriptor, which it otherwise has only while
  /// it is read, for there may be more jobs than descriptors.
  void open() const;
  /// Whether one of its records could not be written, or synced, since forget(); for both threads.
  const std::shared_ptr<std::atomic<bool>>& lost() const { return lost_; }
  /// Where the next record goes: bytes of all before it.
  std::uint64_t size() const { return size_; }

  /// The next record, for write() on whatever thread; it is counted as written.
  std::string encode(Entry& entry, std::string_view xyz, std::string_view factors);
  /// The next record goes there.
  void set_size(std::uint64_t size) { size_ = size; }
  /// All records are void.
  void forget();

  /// What is there, up to the first record that is not whole; a file that is not there is empty.
  /// Reads the heads alone, but for the last record, which is checked. Errors: the file can't be
  /// read, or is none of this kind.
  Result<std::vector<Entry>> scan();
  /// Errors: what the disk gives is not what was written.
  Result<Contents> read(const Entry& entry) const;

  // What the journal's thread does; each may be repeated. They throw std::system_error.
  /// Writes a record at its place, and the file's head before the first.
  static void write(const std::filesystem::path& path, std::uint64_t offset,
                    std::string_view record);
  /// All that was written is on the disk, and so is the file's name.
  static void sync(const std::filesystem::path& path);
  /// Cuts off what comes after `size`.
  static void cut(const std::filesystem::path& path, std::uint64_t size);
  static void remove(const std::filesystem::path& path);

 private:
  std::filesystem::path path_;
  std::uint64_t size_ = head_bytes;
  mutable int held_ = -1;  // what open() opened
  std::shared_ptr<std::atomic<bool>> lost_ = std::make_shared<std::atomic<bool>>(false);
};

}  // namespace metamer::service
