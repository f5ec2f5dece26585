#pragma once

#include <functional>

#include "metamer/v1/worker.pb.h"
#include "server/gl/device.h"
#include "server/gl/passes.h"
#include "server/worker/view_turns.h"

namespace metamer::worker {

/// One job's picture by the GL backend. Belongs to the thread in which the device's context is
/// current.
class GlPicture {
 public:
  /// Takes the geometry and the programs from the device, which makes them where no earlier job
  /// has. `scene`, `method` and the device must outlive it; `key` as Device::geometry has it.
  static Result<GlPicture> make(gl::Device& device, const std::string& key,
                                const RenderScene& scene, const v1::Plan& plan,
                                const Method& method, const std::atomic<bool>& stopped);

  using TileDone = std::function<void(const v1::TileRect& tile, std::uint64_t rays)>;
  /// Renders region by region, each of them whole before its tiles are told; after each sample of a
  /// region the views have their turn. Ends early when `stopped`.
  Result<void> render(const v1::RenderTiles& message, const Film& film,
                      const std::atomic<bool>& stopped, std::atomic<std::uint64_t>& work,
                      ViewTurns& view_turns, const TileDone& tile_done);

  void add_preparation(v1::Timing& timing) const;
  void set_passes(v1::Timing& timing) const;

 private:
  GlPicture(const gl::Device& device, std::shared_ptr<const gl::Geometry> geometry,
            gl::Passes renderer)
      : device_(device), geometry_(std::move(geometry)), renderer_(std::move(renderer)) {}

  const gl::Device& device_;
  std::shared_ptr<const gl::Geometry> geometry_;
  gl::Passes renderer_;
  std::vector<SamplePoint> samples_;
  bool timers_ = false;
  double upload_seconds_ = 0, program_seconds_ = 0;
};

}  // namespace metamer::worker
