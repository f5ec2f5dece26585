#include "client/tools/scene/copy_files.h"

#include <system_error>

#include "common/scene/files.h"
#include "common/scene/limits.h"

namespace metamer::client {
namespace {

namespace fs = std::filesystem;

bool same_content(const fs::path& a, const fs::path& b) {
  const auto first = digest_file(a, limits::max_asset), second = digest_file(b, limits::max_asset);
  return first && second && first->size == second->size && first->sha256 == second->sha256;
}

}  // namespace

Result<CopiedFiles> copy_files(const std::vector<std::string>& names, const fs::path& from,
                               const fs::path& to) {
  CopiedFiles done;
  for (const std::string& name : names) {
    const fs::path relative = fs::path(name).lexically_normal();
    if (relative.is_absolute() || relative.empty() || *relative.begin() == "..")
      return problem(quoted(name) + " lies out of the scene's folder");
    const fs::path source = from / relative, target = to / relative;
    std::error_code error;
    if (fs::exists(target, error)) {
      (same_content(source, target) ? done.same : done.kept).push_back(name);
      continue;
    }
    fs::create_directories(target.parent_path(), error);
    if (!error) fs::copy_file(source, target, error);
    if (error) return problem(quoted(name) + " can't be copied: " + error.message());
    done.copied.push_back(name);
  }
  return done;
}

}  // namespace metamer::client
