#pragma once

#include <atomic>
#include <boost/asio.hpp>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "common/digest.h"

namespace metamer::service {

namespace asio = boost::asio;

/// Reads files, one after the other on a thread of its own: 1 GiB takes a second.
class FileReader {
 public:
  ~FileReader();  ///< Ends in the middle of a file.

  /// Whether a file's bytes have a digest. Nothing: that is not known, for lack of descriptors or
  /// memory, or after stop().
  using Verdict = std::optional<bool>;
  /// Calls `done` in `loop`.
  void check(std::filesystem::path file, const Digest& digest, asio::any_io_executor loop,
             std::function<void(Verdict)> done);
  /// Reads no further.
  void stop() { stopped_ = true; }

 private:
  Verdict has_digest(const std::filesystem::path& file, const Digest& digest);

  std::atomic<bool> stopped_ = false;
  std::vector<char> piece_ = std::vector<char>(256 << 10);  // of the thread
  asio::thread_pool thread_{1};
};

}  // namespace metamer::service
