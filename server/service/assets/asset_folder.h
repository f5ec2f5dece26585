#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "server/service/assets/asset_store.h"

namespace metamer::service {

/// How the folders of workers in a store begin.
inline constexpr std::string_view worker_folder = "worker-";

/// What one worker sees of the store: hard links in a folder of its own, named like the files. The
/// folder lies in the store's, since links do not lead from one file system to another.
class AssetFolder {
 public:
  /// Makes an empty one, which its owner alone can enter. Error: the system's.
  static Result<std::unique_ptr<AssetFolder>> make(const std::filesystem::path& store);
  ~AssetFolder();  ///< Removes it.
  AssetFolder(const AssetFolder&) = delete;
  AssetFolder& operator=(const AssetFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Has the worker see what these hold, and nothing else. Error: a file that can't be linked, and
  /// why; the others are.
  Result<void> show(const std::vector<const AssetHolds*>& all);
  /// The worker says that an asset is damaged: believed of those alone that it sees.
  void doubt(const Digest& digest);

 private:
  explicit AssetFolder(std::filesystem::path path) : path_(std::move(path)) {}
  std::filesystem::path file(const Digest& digest) const { return path_ / to_hex(digest); }

  struct Shown {
    std::shared_ptr<AssetStore> store;
    std::uint64_t inode = 0;
  };
  std::filesystem::path path_;
  std::map<Digest, Shown> shown_;
};

}  // namespace metamer::service
