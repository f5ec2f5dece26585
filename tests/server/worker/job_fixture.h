#pragma once

#include <atomic>
#include <functional>

#include "server/worker/job.h"
#include "tests/server/worker/worker_fixture.h"

namespace metamer::worker {

/// Views that want a turn as often as they are told to.
class FakeTurns : public ViewTurns {
 public:
  bool waiting() const override { return waiting_; }
  void serve() override { ++served_; }
  void serve_while(const std::function<void()>& work) override { work(); }

  std::atomic<bool> waiting_ = false;
  int served_ = 0;
};

class WorkerJob : public WorkerTest {
 protected:
  v1::CompileJob compile_message(const std::string& scene_text) const {
    v1::CompileJob message;
    message.set_scene_sha256(store_scene(scene_text));
    return message;
  }
  /// The picture of 32 by 16 pixels in two tiles.
  static v1::RenderTiles both_tiles() {
    v1::RenderTiles message;
    for (const std::uint32_t x : {16u, 0u}) {
      v1::TileRect& tile = *message.add_tile();
      tile.set_x(x);
      tile.set_width(16);
      tile.set_height(16);
    }
    return message;
  }
  static constexpr const char* settings = "width: 32 height: 16 spp: 4";

  FakeTurns turns_;
  Job job_{5, options_, link_, work_, turns_};
};

}  // namespace metamer::worker
