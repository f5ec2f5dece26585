#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "client/session/error.h"
#include "common/digest.h"
#include "common/scene/scene_file.h"
#include "metamer/v1/assets.pb.h"
#include "metamer/v1/jobs.pb.h"

namespace metamer::client {

/// One asset on its way: bytes in memory (the scene), or a file.
struct Upload {
  Digest sha256{};
  std::uint64_t size = 0;
  std::string name;   ///< For messages.
  std::string bytes;  ///< Used when `path` is empty.
  std::filesystem::path path;
};

/// A job as it is sent: the request, and everything that it refers to by digest, once each.
struct Submission {
  v1::Submit request;
  std::vector<Upload> uploads;
};

/// The same scene always gives the same bytes, so that the server knows it again.
std::string serialise(const v1::Scene& scene);

/// The scene is sent without its looks, which clients apply. `name` is for people. With
/// `check_only` the server compiles and plans, and renders nothing.
Submission make_submission(const v1::Scene& scene, const std::vector<Asset>& assets,
                           std::string name, bool check_only);

/// The pieces of an upload, in order, none larger than `chunk` bytes; an empty asset has one.
class Chunks {
 public:
  /// Error: the file can't be opened.
  static Answer<Chunks> open(const Upload& upload, std::uint64_t chunk);

  bool done() const { return begun_ && offset_ == upload_->size; }
  /// The next piece. Error: the file has become shorter since its digest was made.
  Answer<v1::AssetChunk> next();

 private:
  Chunks(const Upload& upload, std::uint64_t chunk) : upload_(&upload), chunk_(chunk) {}

  const Upload* upload_;
  std::uint64_t chunk_;
  std::uint64_t offset_ = 0;
  bool begun_ = false;
  std::ifstream file_;
};

}  // namespace metamer::client
