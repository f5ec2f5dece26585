#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "server/worker/job.h"
#include "tests/server/worker/fake_backend.h"

namespace metamer::worker {

/// A store, the picture's memory and a link that keeps what a worker sends, in place of a daemon.
class WorkerTest : public ::testing::Test {
 protected:
  WorkerTest();
  ~WorkerTest() override;

  /// Into the store: its digest, as messages have it.
  std::string store(const std::string& bytes) const;
  std::string store_scene(const std::string& text) const;
  /// Puts other bytes, of the same number, in the place of what was stored.
  void spoil(const std::string& digest) const;
  /// All that the worker has sent since the last call, but for its stages. It must not be more than
  /// a socket holds.
  std::vector<v1::WorkerEnvelope> sent();
  /// The same, in short: "planned", "tile_done", "view_event.band".
  std::vector<std::string> sent_names();

  std::vector<std::string> damaged_;        ///< Digests of which the daemon was told.
  std::vector<v1::WorkerEnvelope> stages_;  ///< All that sent() has met: Preparing, Prepared.

  FakeBackend backend_;
  WorkerOptions options_;
  std::unique_ptr<import::Importer> importer_;
  Work work_ = 0;

 private:
  int ends_[2];

 protected:
  Link link_;  ///< The worker's end.
};

using Names = std::vector<std::string>;

/// Settings of a picture that takes no time.
inline constexpr const char* small = "width: 8 height: 4 spp: 4";

/// A ball under a lamp, with these settings, and with more of anything.
std::string ball_scene(const std::string& settings, const std::string& more = {});

}  // namespace metamer::worker
