#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/digest.h"

namespace metamer::fuzz {

/// What the clients of a run have learned, together.
struct Facts {
  std::map<std::uint64_t, std::string> owners;  ///< Of jobs, as Submitted has said.
  std::vector<std::uint64_t> views;
  std::vector<std::string> tokens;  ///< Of a submitter, a viewer, an admin; one that is revoked.

  std::uint64_t requests = 0;  ///< Sent, of all runs.
  std::uint64_t answers = 0;
};

/// Assets: scripts for the workers, and a few bytes.
inline const std::vector<std::string>& all_assets() {
  static const std::vector<std::string> assets = {
      "picture 8 8 8",
      "picture 64 48 16",
      "picture 128 128 8",
      "fail",
      "picture 40 40 8 crash 3",
      "picture 40 40 8 once crash 3",
      "picture 32 32 8 stages",
      "picture 16 16 8 factors 500",
      "picture 16 16 8 broken",
      "picture 16 16 8 verify",
      "picture 24 24 8 refuse",
      "picture 24 24 8 shut",
      "picture 400 400 200",
      "picture 40 40 8 deaf",
      "picture 40 40 8 stuck 2",
      "picture 0 0 8",
      "",
      std::string(70'000, 'x'),
  };
  return assets;
}
inline std::string digest_of(std::size_t asset) {
  static const std::vector<std::string> digests = [] {
    std::vector<std::string> all;
    for (const std::string& text : all_assets()) all.emplace_back(to_bytes(sha256(text)));
    return all;
  }();
  return digests[asset % digests.size()];
}

}  // namespace metamer::fuzz
