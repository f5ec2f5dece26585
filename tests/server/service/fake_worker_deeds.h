#pragma once

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <tuple>

#include "common/wire/worker_exit.h"
#include "server/sandbox/sandbox.h"

/// What a worker tries that was taken over.
namespace metamer::service::test {

/// Enters the sandbox, and names the attempts that succeed: at its `own` asset in its folder, and
/// at `theirs`, somebody else's; both are digests in hex.
inline std::string reached(const std::filesystem::path& folder, const std::string& own,
                           const std::string& theirs) {
  if (!sandbox::enter(folder).lacks.empty()) return "unconfined";
  const std::filesystem::path store = folder / "..";
  const std::tuple<const char*, std::filesystem::path, int> attempts[] = {
      {"own", folder / own, O_RDONLY},
      {"other's", folder / theirs, O_RDONLY},
      {"other's in the store", store / theirs, O_RDONLY},
      {"own in the store", store / own, O_RDONLY},
      {"list", folder, O_RDONLY | O_DIRECTORY},
      {"list the store", store, O_RDONLY | O_DIRECTORY},
      {"write", folder / own, O_WRONLY},
      {"empty", folder / own, O_RDONLY | O_TRUNC},
      {"make", folder / theirs, O_WRONLY | O_CREAT},
  };
  std::string names;
  for (const auto& [name, path, flags] : attempts)
    if (::open(path.c_str(), flags | O_CLOEXEC, 0600) >= 0) names += std::string(name) + ";";
  if (::link((store / theirs).c_str(), (folder / theirs).c_str()) == 0) names += "link;";
  if (::unlink((folder / own).c_str()) == 0) names += "remove;";
  return names;
}

/// Asks for memory and does not touch it: what is limited is what is asked for.
inline void swell() {
  constexpr std::size_t piece = 64u << 20;
  for (int pieces = 0; pieces < 1024; ++pieces)
    if (::mmap(nullptr, piece, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE,
               -1, 0) == MAP_FAILED)
      _exit(wire::exit_out_of_memory);
}

}  // namespace metamer::service::test
