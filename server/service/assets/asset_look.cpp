// What the files of the store hold, and links to them.

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "server/service/assets/asset_store.h"

namespace metamer::service {

namespace {

/// Of one file in a row, while it goes on to change.
constexpr int max_readings = 3;

}  // namespace

asio::awaitable<void> AssetStore::look(std::vector<Digest> digests) {
  const auto self = shared_from_this();
  const asio::any_io_executor loop = co_await asio::this_coro::executor;
  asio::steady_timer signal(loop, asio::steady_timer::time_point::max());
  awaiting_.insert(&signal);
  struct Forget {
    AssetStore& store;
    asio::steady_timer* signal;
    ~Forget() { store.awaiting_.erase(signal); }
  } const forget{*this, &signal};
  for (const Digest& digest : digests)
    for (int i = 0; i < max_readings && begin_reading(digest, loop); ++i)
      while (is_being_read(digest)) co_await signal.async_wait(asio::as_tuple(asio::use_awaitable));
}

/// False where nothing is to be read: the file is the one that was read last, or can't be right.
bool AssetStore::begin_reading(const Digest& digest, const asio::any_io_executor& loop) {
  const auto found = assets_.find(digest);
  if (found == assets_.end()) return false;
  Asset& asset = found->second;
  if (asset.reading != 0) return true;
  const FileStamp stamp = FileStamp::of(file(digest));
  if (stamp == asset.stamp && !asset.doubted) return false;
  asset.stamp = stamp;
  asset.doubted = true;
  asset.reading = ++readings_;
  if (stamp.inode == 0 || stamp.size != asset.size) {
    end_reading(digest, asset.reading, false);
    return false;
  }
  reader_.check(file(digest), digest, loop,
                [store = weak_from_this(), digest, reading = asset.reading](auto verdict) {
                  if (const auto self = store.lock()) self->end_reading(digest, reading, verdict);
                });
  return true;
}

bool AssetStore::is_being_read(const Digest& digest) const {
  const auto found = assets_.find(digest);
  return found != assets_.end() && found->second.reading != 0;
}

void AssetStore::end_reading(const Digest& digest, std::uint64_t reading,
                             FileReader::Verdict verdict) {
  for (asio::steady_timer* const signal : awaiting_) signal->cancel();
  const auto found = assets_.find(digest);
  // It may have been evicted or uploaded anew meanwhile.
  if (found == assets_.end() || found->second.reading != reading) return;
  Asset& asset = found->second;
  asset.reading = 0;
  if (!verdict || FileStamp::of(file(digest)) != asset.stamp) return;
  asset.doubted = false;
  asset.damaged = !*verdict;
  if (asset.damaged) spdlog::error("the store's {} is damaged", file(digest).string());
}

/// What links do to an inode's time is no change of the file.
void AssetStore::keep_stamp(const Digest& digest, const std::function<void()>& act) {
  const auto found = assets_.find(digest);
  const bool same = found != assets_.end() && FileStamp::of(file(digest)) == found->second.stamp;
  act();
  if (same) found->second.stamp = FileStamp::of(file(digest));
}

Result<std::uint64_t> AssetStore::link(const Digest& digest, const std::filesystem::path& to) {
  int error = 0;
  keep_stamp(digest, [&] { error = ::link(file(digest).c_str(), to.c_str()) == 0 ? 0 : errno; });
  if (error == 0) return FileStamp::of(to).inode;
  const bool unable = error == EPERM || error == EOPNOTSUPP || error == EXDEV;
  return problem("can't link " + file(digest).string() + ": " + std::strerror(error) +
                 (unable ? "; the asset store has to be on a file system with hard links" : ""));
}

void AssetStore::unlink(const Digest& digest, const std::filesystem::path& link) {
  keep_stamp(digest, [&] { ::unlink(link.c_str()); });
}

std::uint64_t AssetStore::inode(const Digest& digest) const {
  const auto found = assets_.find(digest);
  return found == assets_.end() ? 0 : found->second.stamp.inode;
}

}  // namespace metamer::service
