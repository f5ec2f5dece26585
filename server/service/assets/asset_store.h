#pragma once

#include <boost/asio.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/digest.h"
#include "common/problem.h"
#include "server/service/access/accounts.h"
#include "server/service/assets/file_reader.h"
#include "server/service/refusal.h"
#include "server/service/store/disk_trouble.h"

namespace metamer::service {

/// What tells that a file is still the one that was looked at, without reading it.
struct FileStamp {
  std::uint64_t device = 0;
  std::uint64_t inode = 0;
  std::uint64_t size = 0;
  std::int64_t modified = 0;  ///< Nanoseconds since 1970, as is the next.
  std::int64_t changed = 0;   ///< Of the inode: programs can't set it.
  bool operator==(const FileStamp&) const = default;

  /// All 0 where there is no regular file.
  static FileStamp of(const std::filesystem::path& file);
};

/// A folder of assets, each a file that is named by the hex of its digest. It holds at most `quota`
/// bytes: the assets that were not used for longest go first, but never one that is held. Whoever
/// holds an asset keeps the store too. A file that was changed or removed behind the store's back
/// makes its asset a damaged one, which counts as missing until it is uploaded anew: look() finds
/// it. For one thread, on which no more is read of a file than the head of a picture.
class AssetStore : public std::enable_shared_from_this<AssetStore> {
 public:
  /// Opens or makes the folder. Left-overs of broken uploads and of workers' folders are removed;
  /// no more of a file is read than a picture's head before look(). Errors: a folder that can't be
  /// made, read or written.
  static Result<std::shared_ptr<AssetStore>> open(std::filesystem::path folder,
                                                  std::uint64_t quota);

  AssetStore(const AssetStore&) = delete;
  AssetStore& operator=(const AssetStore&) = delete;

  /// Waits until those files are read anew that are not the ones that were read last. To be asked
  /// whenever somebody names assets. A file that can't be read now, or that changes all the time,
  /// is left for the worker to judge.
  asio::awaitable<void> look(std::vector<Digest> digests);
  /// As look() has found it.
  bool has(const Digest& digest) const;
  bool damaged(const Digest& digest) const;
  /// And its file is there, with its size.
  bool is_there(const Digest& digest) const;
  /// A worker has read other bytes, or says so: the next look() reads them.
  void doubt(const Digest& digest);

  std::filesystem::path file(const Digest& digest) const { return folder_ / to_hex(digest); }
  /// Makes a hard link to a file, and gives its inode. Error: the system's.
  Result<std::uint64_t> link(const Digest& digest, const std::filesystem::path& to);
  /// Removes one.
  void unlink(const Digest& digest, const std::filesystem::path& link);
  /// Of its file; 0: there was none. It is another one once the asset was uploaded anew.
  std::uint64_t inode(const Digest& digest) const;

  /// The disk is full: removes assets that nobody holds, those unused for longest first, of `bytes`
  /// at least; where there are none, what make_room_by() names makes room. False: neither could.
  bool make_room(std::uint64_t bytes);
  void make_room_by(std::function<bool()> other) { other_room_ = std::move(other); }
  /// Why assets can't be written; nothing while they can. Who writes them says what came of it.
  DiskTrouble& disk() { return disk_; }
  /// While they can't, now and then: writes something that is of no use, which may end the trouble.
  void try_again();

  /// Of assets and of what has come of uploads; never above the quota.
  std::uint64_t bytes() const { return bytes_; }
  const std::filesystem::path& folder() const { return folder_; }
  /// Of files, so far.
  std::uint64_t readings() const { return readings_; }
  /// No file is read any more, so that nobody waits for one.
  void stop() { reader_.stop(); }

 private:
  friend class AssetHolds;
  friend class AssetUpload;

  struct Asset {
    std::uint64_t size = 0;
    std::uint64_t picture_values = 0;           // common/picture_head.h
    std::map<AccountPtr, std::uint64_t> holds;  // how many of each account
    std::list<Digest>::iterator use;            // in by_use_
    FileStamp stamp;                            // of the file that was looked at last,
    bool doubted = false;                       // whose bytes may be others,
    bool damaged = false;                       // or are
    std::uint64_t reading = 0;                  // the number of the reading under way; 0: none
  };

  AssetStore(std::filesystem::path folder, std::uint64_t quota);
  Result<void> scan();
  Asset& insert(const Digest& digest, std::uint64_t size);
  void mend(const Digest& digest, std::uint64_t size);  // its file is there anew
  bool is_unchanged(const Digest& digest) const;
  void keep_stamp(const Digest& digest, const std::function<void()>& act);
  bool begin_reading(const Digest& digest, const asio::any_io_executor& loop);
  bool is_being_read(const Digest& digest) const;
  void end_reading(const Digest& digest, std::uint64_t reading, FileReader::Verdict verdict);
  bool hold(const Digest& digest, const AccountPtr& account);
  void release(const Digest& digest, const AccountPtr& account);
  /// What has to go so that `size` bytes fit. Refused (LIMIT) when what is held leaves too little,
  /// or `account` would hold more than its share.
  tl::expected<std::vector<Digest>, Refusal> victims(std::uint64_t size,
                                                     const AccountPtr& account) const;
  /// Makes room for `size` bytes and counts them as used.
  tl::expected<void, Refusal> take(std::uint64_t size, const AccountPtr& account);
  void evict(const Digest& digest);

  std::filesystem::path folder_;
  std::uint64_t quota_ = 0;
  std::uint64_t bytes_ = 0;
  std::uint64_t kept_ = 0;      // of them, what is held or on its way
  std::uint64_t uploads_ = 0;   // so far; names their files
  std::uint64_t readings_ = 0;  // so far; numbers them
  std::map<Digest, Asset> assets_;
  std::list<Digest> by_use_;                // the one unused for longest first
  std::set<asio::steady_timer*> awaiting_;  // the end of a reading
  FileReader reader_;
  DiskTrouble disk_{"the asset store"};
  std::uint64_t refused_bytes_ = 0;  // that the disk had no room for last
  std::function<bool()> other_room_;
};

/// The assets that a job or a session needs: they stay in the store as long as this lives.
class AssetHolds {
 public:
  /// They count as the account's.
  explicit AssetHolds(AssetStore& store, AccountPtr account = {})
      : store_(store.shared_from_this()), account_(std::move(account)) {}
  ~AssetHolds() { clear(); }
  AssetHolds(AssetHolds&& other) noexcept
      : store_(other.store_), account_(other.account_), held_(std::exchange(other.held_, {})) {}
  AssetHolds& operator=(AssetHolds&&) = delete;

  /// False when the store has no such asset, or a damaged one.
  bool add(const Digest& digest);
  void clear();
  /// One of them that is known to be damaged by now, or not there, if any.
  std::optional<Digest> damaged() const;
  /// "the server's file of NAME is damaged: PATH; send it again"
  std::string describe_damage(const Digest& digest, const std::string& name) const;
  std::size_t size() const { return held_.size(); }
  const std::set<Digest>& digests() const { return held_; }
  const std::shared_ptr<AssetStore>& store() const { return store_; }
  /// Of all of them.
  std::uint64_t bytes() const;
  /// Of one; 0 where it is not held.
  std::uint64_t bytes_of(const Digest& digest) const;
  /// The numbers that the pictures among them become (common/picture_head.h): of all, and of the
  /// one that has most.
  struct Pictures {
    std::uint64_t values = 0, largest = 0;
  };
  Pictures pictures() const;

 private:
  std::shared_ptr<AssetStore> store_;
  AccountPtr account_;
  std::set<Digest> held_;
};

/// One asset on its way into the store: pieces in order into a temporary file, which is removed
/// unless the last piece completes the digest.
class AssetUpload {
 public:
  /// Takes room only as bytes come. Refused: LIMIT for a size above limits::max_asset, no room, or
  /// more than the account's share; INTERNAL when the disk fails.
  static tl::expected<AssetUpload, Refusal> begin(AssetStore& store, AccountPtr account,
                                                  const Digest& digest, std::uint64_t size);
  ~AssetUpload();
  AssetUpload(AssetUpload&& other) noexcept;
  AssetUpload& operator=(AssetUpload&&) = delete;

  const Digest& digest() const { return digest_; }
  std::uint64_t size() const { return size_; }
  bool complete() const { return received_ == size_; }
  const std::filesystem::path& temporary() const { return temporary_; }

  /// Refused: ORDER when `offset` is not where the last piece ended or the piece goes beyond the
  /// size; LIMIT when others have taken the room; INTERNAL when the disk fails. The upload is of no
  /// use then.
  tl::expected<void, Refusal> add(std::uint64_t offset, std::string_view data);
  /// Once complete: puts the asset into the store. Refused: DIGEST.
  tl::expected<void, Refusal> commit();

 private:
  AssetUpload(AssetStore& store, AccountPtr account, const Digest& digest, std::uint64_t size);
  void give_back();
  bool made_room(int error, std::uint64_t bytes);
  tl::unexpected<Refusal> disk_refuses(int error);

  std::shared_ptr<AssetStore> store_;
  AccountPtr account_;
  Digest digest_;
  std::uint64_t size_ = 0;
  std::uint64_t received_ = 0;
  DigestStream sum_;
  std::filesystem::path temporary_;
  int fd_ = -1;
};

}  // namespace metamer::service
