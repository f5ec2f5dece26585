#include "server/service/assets/asset_folder.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>

namespace metamer::service {

Result<std::unique_ptr<AssetFolder>> AssetFolder::make(const std::filesystem::path& store) {
  std::string path = store / (std::string(worker_folder) + "XXXXXX");
  if (::mkdtemp(path.data()) == nullptr)
    return problem("can't make a worker's folder in " + store.string() + ": " +
                   std::strerror(errno));
  return std::unique_ptr<AssetFolder>(new AssetFolder(path));
}

AssetFolder::~AssetFolder() {
  (void)show({});
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

Result<void> AssetFolder::show(const std::vector<const AssetHolds*>& all) {
  std::map<Digest, const std::shared_ptr<AssetStore>*> wanted;
  for (const AssetHolds* const holds : all)
    for (const Digest& digest : holds->digests()) wanted.emplace(digest, &holds->store());

  // Take away what is not wanted, and what is another file by now.
  std::erase_if(shown_, [&](const auto& shown) {
    const auto& [digest, link] = shown;
    if (wanted.contains(digest) && link.store->inode(digest) == link.inode) return false;
    link.store->unlink(digest, file(digest));
    return true;
  });

  Result<void> result;
  for (const auto& [digest, store] : wanted) {
    if (shown_.contains(digest)) continue;
    const auto inode = (*store)->link(digest, file(digest));
    if (inode)
      shown_.emplace(digest, Shown{*store, *inode});
    else if (result)
      result = tl::unexpected(inode.error());
  }
  return result;
}

void AssetFolder::doubt(const Digest& digest) {
  if (const auto found = shown_.find(digest); found != shown_.end())
    found->second.store->doubt(digest);
}

}  // namespace metamer::service
