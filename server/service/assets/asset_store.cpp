#include "server/service/assets/asset_store.h"

#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <fstream>
#include <optional>
#include <utility>

namespace metamer::service {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t hex_size = 2 * std::tuple_size_v<Digest>;

/// The digest that a file is named by; nothing for any other name.
std::optional<Digest> digest_of_name(const std::string& name) {
  if (name.size() != hex_size) return std::nullopt;
  const auto nibble = [](char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    return -1;
  };
  Digest digest{};
  for (std::size_t i = 0; i < digest.size(); ++i) {
    const int high = nibble(name[2 * i]);
    const int low = nibble(name[2 * i + 1]);
    if (high < 0 || low < 0) return std::nullopt;
    digest[i] = static_cast<unsigned char>(high * 16 + low);
  }
  return digest;
}

/// The digest of a file's bytes, and their number.
std::pair<Digest, std::uint64_t> digest_of_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  DigestStream sum;
  std::uint64_t size = 0;
  std::vector<char> piece(1 << 20);
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0) {
    const auto got = static_cast<std::size_t>(file.gcount());
    sum.update({piece.data(), got});
    size += got;
  }
  return {sum.finish(), size};
}

std::int64_t nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

}  // namespace

FileStamp FileStamp::of(const fs::path& file) {
  struct stat status {};
  if (::lstat(file.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  return {status.st_dev, status.st_ino, static_cast<std::uint64_t>(status.st_size),
          nanoseconds(status.st_mtim), nanoseconds(status.st_ctim)};
}

AssetStore::AssetStore(fs::path folder, std::uint64_t quota)
    : folder_(std::move(folder)), quota_(quota) {}

Result<std::shared_ptr<AssetStore>> AssetStore::open(fs::path folder, std::uint64_t quota) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    return problem("can't make the store's folder " + folder.string() + ": " + error.message());
  }
  auto store = std::shared_ptr<AssetStore>(new AssetStore(std::move(folder), quota));
  if (auto scanned = store->scan(); !scanned) return tl::unexpected(scanned.error());
  return store;
}

Result<void> AssetStore::scan() {
  // Take over the assets, oldest first, and clear away what is none.
  struct Found {
    fs::file_time_type time;
    fs::path path;
  };
  std::vector<Found> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& path = entry->path();
    std::error_code ignored;
    if (path.filename().string().starts_with("upload-")) fs::remove(path, ignored);
    if (!digest_of_name(path.filename().string()) || !entry->is_regular_file(ignored)) continue;
    found.push_back({entry->last_write_time(ignored), path});
  }
  if (error) return problem("can't read the store " + folder_.string() + ": " + error.message());
  std::sort(found.begin(), found.end(),
            [](const Found& a, const Found& b) { return a.time < b.time; });
  for (const Found& asset : found) {
    const auto [digest, size] = digest_of_file(asset.path);
    if (to_hex(digest) == asset.path.filename() && take(size, nullptr)) {
      insert(digest, size);
    } else {
      fs::remove(asset.path, error);
    }
  }
  return {};
}

void AssetStore::insert(const Digest& digest, std::uint64_t size) {
  assert(!assets_.contains(digest));
  const auto use = by_use_.insert(by_use_.end(), digest);
  assets_.emplace(digest, Asset{size, {}, use, FileStamp::of(file(digest))});
}

bool AssetStore::has(const Digest& digest) {
  const auto found = assets_.find(digest);
  if (found == assets_.end() || found->second.damaged) return false;
  Asset& asset = found->second;
  const FileStamp stamp = FileStamp::of(file(digest));
  if (stamp == asset.stamp) return true;
  asset.damaged = stamp.size != asset.size || digest_of_file(file(digest)).first != digest;
  if (asset.damaged) spdlog::error("the store's {} is damaged", file(digest).string());
  asset.stamp = stamp;
  return !asset.damaged;
}

bool AssetStore::damaged(const Digest& digest) const {
  const auto found = assets_.find(digest);
  return found != assets_.end() && found->second.damaged;
}

void AssetStore::mend(const Digest& digest) {
  Asset& asset = assets_.at(digest);
  asset.stamp = FileStamp::of(file(digest));
  asset.damaged = false;
}

bool AssetStore::hold(const Digest& digest, const AccountPtr& account) {
  if (!has(digest)) return false;
  Asset& asset = assets_.at(digest);
  if (asset.holds.empty()) kept_ += asset.size;
  if (++asset.holds[account] == 1 && account) account->asset_bytes += asset.size;
  by_use_.splice(by_use_.end(), by_use_, asset.use);
  return true;
}

void AssetStore::release(const Digest& digest, const AccountPtr& account) {
  Asset& asset = assets_.at(digest);
  const auto found = asset.holds.find(account);
  assert(found != asset.holds.end());
  if (--found->second > 0) return;
  asset.holds.erase(found);
  if (account) account->asset_bytes -= asset.size;
  if (asset.holds.empty()) kept_ -= asset.size;
}

tl::expected<std::vector<Digest>, Refusal> AssetStore::victims(std::uint64_t size,
                                                               const AccountPtr& account) const {
  if (account && account->max_bytes &&
      account->asset_bytes + size > static_cast<std::uint64_t>(*account->max_bytes)) {
    return refuse(v1::Error::LIMIT, account->name + " may have " +
                                        std::to_string(*account->max_bytes) + " bytes of assets");
  }
  if (account && kept_ + size <= quota_ && !may_take(account->asset_bytes, size, quota_ - kept_)) {
    return refuse(v1::Error::LIMIT, account->name + " has its share of the asset store: " +
                                        std::to_string(account->asset_bytes) + " of its " +
                                        std::to_string(quota_) + " bytes");
  }
  std::vector<Digest> victims;
  std::uint64_t freed = 0;
  for (auto oldest = by_use_.begin(); bytes_ - freed + size > quota_; ++oldest) {
    if (oldest == by_use_.end()) {
      return refuse(v1::Error::LIMIT, "the asset store is full: " + std::to_string(size) +
                                          " bytes do not fit beside the " +
                                          std::to_string(bytes_ - freed) +
                                          " in use; its quota is " + std::to_string(quota_));
    }
    const Asset& asset = assets_.at(*oldest);
    if (!asset.holds.empty()) continue;
    freed += asset.size;
    victims.push_back(*oldest);
  }
  return victims;
}

tl::expected<void, Refusal> AssetStore::take(std::uint64_t size, const AccountPtr& account) {
  // Choose what has to go before anything goes: a request that can't be met costs nothing.
  const auto chosen = victims(size, account);
  if (!chosen) return tl::unexpected(chosen.error());
  for (const Digest& victim : *chosen) evict(victim);
  bytes_ += size;
  return {};
}

void AssetStore::evict(const Digest& digest) {
  const auto found = assets_.find(digest);
  std::error_code ignored;
  fs::remove(file(digest), ignored);
  bytes_ -= found->second.size;
  by_use_.erase(found->second.use);
  assets_.erase(found);
}

bool AssetHolds::add(const Digest& digest) {
  if (held_.contains(digest)) return store_->has(digest);
  if (!store_->hold(digest, account_)) return false;
  held_.insert(digest);
  return true;
}

void AssetHolds::clear() {
  for (const Digest& digest : held_) store_->release(digest, account_);
  held_.clear();
}

std::uint64_t AssetHolds::bytes() const {
  std::uint64_t sum = 0;
  for (const Digest& digest : held_) sum += bytes_of(digest);
  return sum;
}

std::uint64_t AssetHolds::bytes_of(const Digest& digest) const {
  const auto asset = store_->assets_.find(digest);
  return held_.contains(digest) && asset != store_->assets_.end() ? asset->second.size : 0;
}

std::optional<Digest> AssetHolds::damaged() const {
  const auto found = std::find_if(held_.begin(), held_.end(),
                                  [&](const auto& held) { return !store_->has(held); });
  return found == held_.end() ? std::nullopt : std::optional(*found);
}

std::string AssetHolds::describe_damage(const Digest& digest, const std::string& name) const {
  return "the server's file of " + name + " is damaged: " + store_->file(digest).string() +
         "; send it again";
}

}  // namespace metamer::service
