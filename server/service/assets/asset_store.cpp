#include "server/service/assets/asset_store.h"

#include <spdlog/spdlog.h>
#include <sys/stat.h>

#include <algorithm>
#include <cassert>
#include <fstream>
#include <optional>
#include <utility>

#include "common/picture_head.h"
#include "server/service/assets/asset_folder.h"
#include "server/service/store/durable_file.h"

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

std::int64_t nanoseconds(const timespec& time) {
  return std::int64_t{time.tv_sec} * 1'000'000'000 + time.tv_nsec;
}

std::uint64_t picture_values_of(const fs::path& path, std::uint64_t size) {
  std::ifstream file(path, std::ios::binary);
  std::string head(8, '\0');
  if (!file.read(head.data(), 8) || !begins_picture(head)) return 0;
  head.resize(picture_head_bytes);
  file.read(head.data() + 8, static_cast<std::streamsize>(head.size() - 8));
  head.resize(8 + static_cast<std::size_t>(file.gcount()));
  return picture_values(head, size);
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
  if (auto made = make_folder(folder, "the store's folder"); !made)
    return tl::unexpected(made.error());
  auto store = std::shared_ptr<AssetStore>(new AssetStore(std::move(folder), quota));
  if (auto scanned = store->scan(); !scanned) return tl::unexpected(scanned.error());
  return store;
}

Result<void> AssetStore::scan() {
  // Take over the assets, oldest first, and clear away what is none.
  struct Found {
    fs::file_time_type time;
    std::uint64_t size;
    Digest digest;
  };
  std::vector<Found> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code ignored;
    if (name.starts_with("upload-")) fs::remove(entry->path(), ignored);
    if (name.starts_with(worker_folder)) fs::remove_all(entry->path(), ignored);
    const auto digest = digest_of_name(name);
    if (digest && FileStamp::of(entry->path()).inode != 0)
      found.push_back({entry->last_write_time(ignored), entry->file_size(ignored), *digest});
  }
  if (error) return problem("can't read the store " + folder_.string() + ": " + error.message());
  std::sort(found.begin(), found.end(),
            [](const Found& a, const Found& b) { return a.time < b.time; });
  for (const Found& asset : found) {
    if (take(asset.size, nullptr))
      insert(asset.digest, asset.size).doubted = true;
    else
      fs::remove(file(asset.digest), error);
  }
  return {};
}

AssetStore::Asset& AssetStore::insert(const Digest& digest, std::uint64_t size) {
  assert(!assets_.contains(digest));
  const auto use = by_use_.insert(by_use_.end(), digest);
  return assets_
      .emplace(digest, Asset{.size = size,
                             .picture_values = picture_values_of(file(digest), size),
                             .holds = {},
                             .use = use,
                             .stamp = FileStamp::of(file(digest))})
      .first->second;
}

void AssetStore::mend(const Digest& digest, std::uint64_t size) {
  // What was found at the start may have had another size, by which it was counted.
  Asset& asset = assets_.at(digest);
  const std::uint64_t more = size - asset.size;
  for (const auto& [account, count] : asset.holds)
    if (account) account->asset_bytes += more;
  if (!asset.holds.empty()) kept_ += more;
  bytes_ += more;
  asset.size = size;
  asset.picture_values = picture_values_of(file(digest), size);
  asset.stamp = FileStamp::of(file(digest));
  asset.doubted = asset.damaged = false;
  asset.reading = 0;
}

bool AssetStore::has(const Digest& digest) const {
  const auto found = assets_.find(digest);
  return found != assets_.end() && !found->second.damaged;
}

bool AssetStore::damaged(const Digest& digest) const {
  const auto found = assets_.find(digest);
  return found != assets_.end() && found->second.damaged;
}

bool AssetStore::is_there(const Digest& digest) const {
  if (!has(digest)) return false;
  const FileStamp stamp = FileStamp::of(file(digest));
  return stamp.inode != 0 && stamp.size == assets_.at(digest).size;
}

/// Its bytes were read, or came, and are the same still.
bool AssetStore::is_unchanged(const Digest& digest) const {
  const auto found = assets_.find(digest);
  return found != assets_.end() && !found->second.damaged && !found->second.doubted &&
         found->second.stamp == FileStamp::of(file(digest));
}

void AssetStore::doubt(const Digest& digest) {
  const auto found = assets_.find(digest);
  if (found == assets_.end() || found->second.doubted) return;
  spdlog::error("a worker found the store's {} to be damaged", file(digest).string());
  found->second.doubted = true;
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
      // What others have is theirs, and an admin's, to know.
      const bool tells = !account || account->admin;
      const std::string in_use = std::to_string(bytes_ - freed) + " in use";
      return refuse(v1::Error::LIMIT, "the asset store is full: " + std::to_string(size) +
                                          " bytes do not fit beside " +
                                          (tells ? "the " + in_use : "what is in use") +
                                          "; its quota is " + std::to_string(quota_));
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

bool AssetStore::make_room(std::uint64_t bytes) {
  std::vector<Digest> unheld;
  std::uint64_t freed = 0;
  for (auto oldest = by_use_.begin(); freed < bytes && oldest != by_use_.end(); ++oldest) {
    const Asset& asset = assets_.at(*oldest);
    if (!asset.holds.empty() || asset.size == 0) continue;
    freed += asset.size;
    unheld.push_back(*oldest);
  }
  for (const Digest& digest : unheld) evict(digest);
  if (freed > 0)
    spdlog::info("the disk is full: {} assets that nobody holds make room", unheld.size());
  return freed > 0 || (other_room_ && other_room_());
}

void AssetStore::try_again() {
  if (!disk_.text()) return;
  try {
    try_to_write(folder_ / "upload-try", refused_bytes_);
    disk_.taken();
  } catch (const std::system_error& error) {
    disk_.refused(error.code().message());
  }
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

AssetHolds::Pictures AssetHolds::pictures() const {
  Pictures pictures;
  for (const Digest& digest : held_) {
    const auto asset = store_->assets_.find(digest);
    if (asset == store_->assets_.end()) continue;
    pictures.values += asset->second.picture_values;
    pictures.largest = std::max(pictures.largest, asset->second.picture_values);
  }
  return pictures;
}

std::optional<Digest> AssetHolds::damaged() const {
  const auto found = std::find_if(held_.begin(), held_.end(),
                                  [&](const auto& held) { return !store_->is_there(held); });
  return found == held_.end() ? std::nullopt : std::optional(*found);
}

std::string AssetHolds::describe_damage(const Digest& digest, const std::string& name) const {
  return "the server's file of " + name + " is damaged: " + store_->file(digest).string() +
         "; send it again";
}

}  // namespace metamer::service
