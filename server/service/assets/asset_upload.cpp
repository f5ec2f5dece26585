#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cassert>
#include <cerrno>
#include <cstring>
#include <utility>

#include "common/scene/limits.h"
#include "server/service/assets/asset_store.h"

namespace metamer::service {

namespace fs = std::filesystem;

AssetUpload::AssetUpload(AssetStore& store, AccountPtr account, const Digest& digest,
                         std::uint64_t size)
    : store_(store.shared_from_this()),
      account_(std::move(account)),
      digest_(digest),
      size_(size),
      temporary_(store.folder() / ("upload-" + std::to_string(++store.uploads_))) {}

AssetUpload::AssetUpload(AssetUpload&& other) noexcept
    : store_(std::exchange(other.store_, nullptr)),
      account_(other.account_),
      digest_(other.digest_),
      size_(other.size_),
      received_(other.received_),
      sum_(std::move(other.sum_)),
      temporary_(std::move(other.temporary_)),
      fd_(std::exchange(other.fd_, -1)) {}

AssetUpload::~AssetUpload() {
  if (fd_ >= 0) ::close(fd_);
  if (!store_) return;
  give_back();
  store_->bytes_ -= received_;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

tl::expected<AssetUpload, Refusal> AssetUpload::begin(AssetStore& store, AccountPtr account,
                                                      const Digest& digest, std::uint64_t size) {
  if (size > limits::max_asset) {
    return refuse(v1::Error::LIMIT, "an asset of " + std::to_string(size) +
                                        " bytes is over the limit of " +
                                        std::to_string(limits::max_asset));
  }
  if (auto room = store.victims(size, account); !room) return tl::unexpected(room.error());
  AssetUpload upload(store, std::move(account), digest, size);
  int error = 0;
  do {
    upload.fd_ = ::open(upload.temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    error = errno;
  } while (upload.fd_ < 0 && upload.made_room(error, size));
  if (upload.fd_ < 0) return upload.disk_refuses(error);
  return upload;
}

tl::expected<void, Refusal> AssetUpload::add(std::uint64_t offset, std::string_view data) {
  if (offset != received_) {
    return refuse(v1::Error::ORDER, "a chunk at offset " + std::to_string(offset) +
                                        " came where offset " + std::to_string(received_) +
                                        " was due");
  }
  if (data.size() > size_ - received_) {
    return refuse(v1::Error::ORDER,
                  "a chunk ends beyond its asset's " + std::to_string(size_) + " bytes");
  }
  if (auto room = store_->take(data.size(), account_); !room) return room;
  sum_.update(data);
  received_ += data.size();
  store_->kept_ += data.size();
  if (account_) account_->asset_bytes += data.size();
  while (!data.empty()) {
    const ssize_t written = ::write(fd_, data.data(), data.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) {
      const int error = errno;
      store_->refused_bytes_ = data.size();
      if (made_room(error, data.size() + size_ - received_)) continue;
      return disk_refuses(error);
    }
    data.remove_prefix(static_cast<std::size_t>(written));
  }
  store_->disk_.taken();
  return {};
}

/// Whether a write is worth another try, of so many bytes that are to come.
bool AssetUpload::made_room(int error, std::uint64_t bytes) {
  return is_want_of_room(error) && store_->make_room(std::max<std::uint64_t>(bytes, 1));
}

tl::unexpected<Refusal> AssetUpload::disk_refuses(int error) {
  store_->disk_.refused(std::strerror(error));
  return refuse(v1::Error::INTERNAL,
                std::string("can't write into the asset store: ") + std::strerror(error));
}

/// What has come is no longer kept on this upload's account.
void AssetUpload::give_back() {
  store_->kept_ -= received_;
  if (account_) account_->asset_bytes -= received_;
}

tl::expected<void, Refusal> AssetUpload::commit() {
  assert(complete());
  if (const Digest sum = sum_.finish(); sum != digest_) {
    return refuse(v1::Error::DIGEST,
                  "the asset offered as " + to_hex(digest_) + " has the digest " + to_hex(sum));
  }
  // Somebody else may have sent the same one meanwhile; then this one is thrown away.
  if (store_->is_unchanged(digest_)) return {};
  std::error_code error;
  do {
    fs::rename(temporary_, store_->file(digest_), error);
  } while (error && made_room(error.value(), 1));
  if (error) return disk_refuses(error.value());
  // The bytes of one that was damaged are counted already.
  if (store_->assets_.contains(digest_))
    return store_->mend(digest_, size_), tl::expected<void, Refusal>();
  give_back();
  std::exchange(store_, nullptr)->insert(digest_, size_);
  return {};
}

}  // namespace metamer::service
