#include "server/service/store/tile_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "server/service/store/crc32c.h"
#include "server/service/store/durable_file.h"

namespace metamer::service {

namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::string_view tile_file_mark = "MTMTILE1";

constexpr std::uint64_t sync_bytes = 64u << 20;

/// As it stands in the file.
struct RecordHead {
  std::uint32_t tile = 0;
  std::uint32_t xyz_bytes = 0;
  std::uint32_t factor_bytes = 0;
  std::uint32_t sum = 0;
  std::uint64_t sequence = 0;
  std::uint64_t rays = 0;
  double time = 0;
};
static_assert(sizeof(RecordHead) == 40);

/// Of head and bytes, the sum itself being 0.
std::uint32_t sum_of(RecordHead head, std::string_view bytes) {
  head.sum = 0;
  return crc32c(bytes, crc32c({reinterpret_cast<const char*>(&head), sizeof head}));
}

[[noreturn]] void fail(const std::filesystem::path& path) {
  throw std::system_error(errno, std::generic_category(), path.string());
}

struct Descriptor {
  explicit Descriptor(const std::filesystem::path& path, int flags)
      : fd(::open(path.c_str(), flags | O_CLOEXEC, 0600)) {
    if (fd < 0) fail(path);
  }
  ~Descriptor() { ::close(fd); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int fd;
};

void write_at(int fd, std::uint64_t offset, std::string_view bytes,
              const std::filesystem::path& path) {
  while (!bytes.empty()) {
    const ssize_t written = ::pwrite(fd, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path);
    bytes.remove_prefix(static_cast<std::size_t>(written));
    offset += static_cast<std::uint64_t>(written);
  }
}

/// The descriptor that is held, or one for the time of reading; -1 and errno where there is none.
struct Reading {
  Reading(int held, const std::filesystem::path& path)
      : fd(held >= 0 ? held : ::open(path.c_str(), O_RDONLY | O_CLOEXEC)), own(held < 0) {}
  ~Reading() {
    if (own && fd >= 0) ::close(fd);
  }
  Reading(const Reading&) = delete;
  const int fd;
  const bool own;
};

bool read_at(int fd, std::uint64_t offset, void* to, std::size_t size) {
  auto* bytes = static_cast<char*>(to);
  while (size > 0) {
    const ssize_t got = ::pread(fd, bytes, size, static_cast<off_t>(offset));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes += got;
    offset += static_cast<std::uint64_t>(got);
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace

TileFile::~TileFile() {
  if (held_ >= 0) ::close(held_);
}

void TileFile::open() const {
  if (held_ < 0) held_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
}

std::string TileFile::encode(Entry& entry, std::string_view xyz, std::string_view factors) {
  entry.offset = size_;
  entry.xyz_bytes = static_cast<std::uint32_t>(xyz.size());
  entry.factor_bytes = static_cast<std::uint32_t>(factors.size());
  RecordHead head{entry.tile,     entry.xyz_bytes, entry.factor_bytes, 0,
                  entry.sequence, entry.rays,      entry.time};
  std::string record(sizeof head, '\0');
  record.reserve(sizeof head + xyz.size() + factors.size());
  record += xyz;
  record += factors;
  head.sum = sum_of(head, std::string_view(record).substr(sizeof head));
  std::memcpy(record.data(), &head, sizeof head);
  size_ += record.size();
  return record;
}

void TileFile::forget() {
  size_ = head_bytes;
  lost_ = std::make_shared<std::atomic<bool>>(false);
}

Result<std::vector<TileFile::Entry>> TileFile::scan() {
  std::vector<Entry> entries;
  forget();
  const Reading file(held_, path_);
  if (file.fd < 0) {
    if (errno == ENOENT) return entries;
    return problem("can't read " + path_.string() + ": " + std::strerror(errno));
  }
  struct stat status {};
  if (::fstat(file.fd, &status) != 0)
    return problem("can't read " + path_.string() + ": " + std::strerror(errno));
  const auto end = static_cast<std::uint64_t>(status.st_size);
  std::string mark(tile_file_mark.size(), '\0');
  if (end < head_bytes) return entries;
  if (!read_at(file.fd, 0, mark.data(), mark.size()) || mark != tile_file_mark)
    return problem(path_.string() + " is no file of tiles");

  // Appended in order: what is whole at its end is whole before it, unless the disk lies, which
  // read() finds.
  while (end - size_ >= sizeof(RecordHead)) {
    RecordHead head;
    if (!read_at(file.fd, size_, &head, sizeof head)) break;
    const std::uint64_t bytes = std::uint64_t{head.xyz_bytes} + head.factor_bytes;
    if (bytes > end - size_ - sizeof head) break;
    entries.push_back(
        {head.tile, head.sequence, head.rays, head.time, size_, head.xyz_bytes, head.factor_bytes});
    size_ += sizeof head + bytes;
  }
  while (!entries.empty() && !read(entries.back())) {
    size_ = entries.back().offset;
    entries.pop_back();
  }
  return entries;
}

Result<TileFile::Contents> TileFile::read(const Entry& entry) const {
  const Reading file(held_, path_);
  if (file.fd < 0) return problem("can't read " + path_.string() + ": " + std::strerror(errno));
  RecordHead head;
  std::string bytes(std::size_t{entry.xyz_bytes} + entry.factor_bytes, '\0');
  const bool whole = read_at(file.fd, entry.offset, &head, sizeof head) &&
                     head.tile == entry.tile && head.xyz_bytes == entry.xyz_bytes &&
                     head.factor_bytes == entry.factor_bytes &&
                     read_at(file.fd, entry.offset + sizeof head, bytes.data(), bytes.size()) &&
                     sum_of(head, bytes) == head.sum;
  if (!whole)
    return problem("tile " + std::to_string(entry.tile) + " is damaged in " + path_.string());
  Contents contents;
  contents.factors = bytes.substr(entry.xyz_bytes);
  bytes.resize(entry.xyz_bytes);
  contents.xyz = std::move(bytes);
  return contents;
}

void TileFile::write(const std::filesystem::path& path, std::uint64_t offset,
                     std::string_view record) {
  const Descriptor file(path, O_WRONLY | O_CREAT);
  if (offset == head_bytes) write_at(file.fd, 0, tile_file_mark, path);
  write_at(file.fd, offset, record, path);
  // Now and then, so that the last sync of a large picture keeps nobody else's change waiting.
  if (offset / sync_bytes != (offset + record.size()) / sync_bytes && ::fdatasync(file.fd) != 0)
    throw SyncError(errno, std::generic_category(), path.string());
}

void TileFile::sync(const std::filesystem::path& path) { sync_file(path); }

void TileFile::cut(const std::filesystem::path& path, std::uint64_t size) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return;
  std::filesystem::resize_file(path, size);
}

void TileFile::remove(const std::filesystem::path& path) {
  std::error_code ignored;
  std::filesystem::remove(path, ignored);
}

}  // namespace metamer::service
