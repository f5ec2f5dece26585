#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/problem.h"

namespace metamer::client {

/// What became of the files of a scene that were to be copied, by their names in the scene.
struct CopiedFiles {
  std::vector<std::string> copied;
  std::vector<std::string> same;  ///< They were there already.
  std::vector<std::string> kept;  ///< Others of their names were there, and still are.
};

/// Copies the files that a scene in folder `from` names into folder `to`, with the folders in
/// between. Nothing that is there is overwritten. Error: the first that can't be read or written;
/// those before it are copied.
Result<CopiedFiles> copy_files(const std::vector<std::string>& names,
                               const std::filesystem::path& from, const std::filesystem::path& to);

}  // namespace metamer::client
