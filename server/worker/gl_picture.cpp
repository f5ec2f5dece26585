#include "server/worker/gl_picture.h"

#include <chrono>
#include <cstdlib>

#include "server/gl/regions.h"

namespace metamer::worker {

using Clock = std::chrono::steady_clock;

namespace {

/// A hook for tests: after so many samples of regions the context is gone, as a GPU that is reset
/// takes it. 0: never.
long samples_until_loss() {
  const char* text = std::getenv("METAMER_TEST_LOSE_CONTEXT");
  return text ? std::strtol(text, nullptr, 10) : 0;
}

}  // namespace

Result<GlPicture> GlPicture::make(gl::Device& device, const std::string& key,
                                  const RenderScene& scene, const v1::Plan& plan,
                                  const Method& method, const std::atomic<bool>& stopped) {
  const auto start = Clock::now();
  auto geometry = device.geometry(key, scene, stopped);
  if (!geometry) return tl::unexpected(geometry.error());
  const auto uploaded = Clock::now();
  auto renderer = gl::Passes::create(scene, **geometry, plan, method, device.programs(),
                                     device.capabilities().timers());
  if (!renderer) return tl::unexpected(renderer.error());
  GlPicture picture(device, std::move(*geometry), std::move(*renderer));
  picture.samples_ = sample_pattern(plan.spp());
  picture.timers_ = device.capabilities().timers();
  picture.upload_seconds_ = std::chrono::duration<double>(uploaded - start).count();
  picture.program_seconds_ = std::chrono::duration<double>(Clock::now() - uploaded).count();
  return picture;
}

Result<void> GlPicture::render(const v1::RenderTiles& message, const Film& film,
                               const std::atomic<bool>& stopped, std::atomic<std::uint64_t>& work,
                               ViewTurns& view_turns, const TileDone& tile_done) {
  static const long loss = samples_until_loss();
  static long samples = 0;
  const auto others = [&] {
    if (loss > 0 && ++samples == loss) device_.context().release();
    if (!view_turns.waiting()) return false;
    view_turns.serve();
    return true;
  };
  for (const gl::Region& region : gl::regions_of(message, gl::Passes::max_side)) {
    if (auto done = renderer_.render(region.rect, film, samples_, stopped, work, others); !done)
      return done;
    if (stopped) return {};
    // Camera rays alone: the GPU does not count those of shadows.
    for (const v1::TileRect& tile : region.tiles)
      tile_done(tile, std::uint64_t{tile.width()} * tile.height() * samples_.size());
  }
  return {};
}

void GlPicture::add_preparation(v1::Timing& timing) const {
  timing.set_acceleration(timing.acceleration() + upload_seconds_);
  timing.set_prepare(timing.prepare() + program_seconds_);
}

void GlPicture::set_passes(v1::Timing& timing) const {
  timing.clear_pass();
  for (const gl::Pass pass : gl::all_passes) {
    v1::PassTime& time = *timing.add_pass();
    time.set_name(gl::name_of(pass));
    time.set_seconds(renderer_.clock().seconds(pass));
    time.set_gpu(timers_);
  }
}

}  // namespace metamer::worker
