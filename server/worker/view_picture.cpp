#include "server/worker/view_picture.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>

#include "server/cpu/tracer.h"
#include "server/film/pixel_sink.h"
#include "server/gl/device.h"
#include "server/gl/passes.h"
#include "server/worker/view_turns.h"

namespace metamer::worker {
namespace {

/// A draw ends by its time, and by nothing else.
const std::atomic<bool> no_end = false;

class CpuPicture : public ViewPicture {
 public:
  CpuPicture(const RenderScene& scene, cpu::EmbreeScene geometry)
      : scene_(scene), geometry_(std::move(geometry)) {}

  Result<void> change(const v1::Plan& plan, const Method& method) override {
    plan_ = &plan;
    method_ = &method;
    return {};
  }

  Result<bool> draw(const Film& film, std::span<const SamplePoint> samples, Clock::time_point until,
                    std::uint32_t& next, Work& work) override {
    const cpu::Tracer tracer(
        scene_, geometry_,
        cpu::Tracer::Frame{
            film.width, film.height, plan_->depth(), {samples.begin(), samples.end()}});
    constexpr std::uint32_t side = 16;
    const std::uint32_t columns = (film.width + side - 1) / side;
    const std::uint32_t tiles = columns * ((film.height + side - 1) / side);
    std::atomic<std::uint32_t> taken = next;
    tbb::task_arena arena(static_cast<int>(plan_->threads()));
    arena.execute([&] {
      tbb::parallel_for(0u, plan_->threads(), [&](unsigned) {
        cpu::Tracer::Workspace workspace = tracer.make_workspace();
        FilmSink sink(*method_, film, static_cast<std::uint32_t>(samples.size()));
        // Who has taken a tile draws it: those before `taken` are all done in the end.
        do {
          const std::uint32_t i = taken++;
          if (i >= tiles) return;
          const std::uint32_t x = i % columns * side, y = i / columns * side;
          tracer.render({x, y, std::min(side, film.width - x), std::min(side, film.height - y)},
                        sink, workspace, no_end, work);
        } while (Clock::now() < until);
      });
    });
    next = std::min<std::uint32_t>(taken, tiles);
    return next == tiles;
  }

 private:
  const RenderScene& scene_;
  cpu::EmbreeScene geometry_;
  const v1::Plan* plan_ = nullptr;
  const Method* method_ = nullptr;
};

class GpuPicture : public ViewPicture {
 public:
  GpuPicture(const RenderScene& scene, gl::Device& device,
             std::shared_ptr<const gl::Geometry> geometry)
      : scene_(scene), device_(device), geometry_(std::move(geometry)) {}

  Result<void> change(const v1::Plan& plan, const Method& method) override {
    auto renderer = gl::Passes::create(scene_, *geometry_, plan, method, device_.programs(),
                                       device_.capabilities().timers());
    if (!renderer) return tl::unexpected(renderer.error());
    renderer_.emplace(std::move(*renderer));
    return {};
  }

  Result<bool> draw(const Film& film, std::span<const SamplePoint> samples, Clock::time_point until,
                    std::uint32_t& next, Work& work) override {
    do {
      const auto start = Clock::now();
      const std::uint32_t rows = std::min(rows_at_once(film.width), film.height - next);
      const Rect region{0, next, film.width, rows};
      if (auto done = renderer_->render(region, film, samples, no_end, work); !done)
        return tl::unexpected(done.error());
      next += rows;
      const std::chrono::duration<double> taken = Clock::now() - start;
      pixel_seconds_ = taken.count() / static_cast<double>(std::uint64_t{film.width} * rows);
    } while (next < film.height && Clock::now() < until);
    return next == film.height;
  }

 private:
  /// As many as take about a turn's time and fit into memory with what their pixels gather of each
  /// light. A GPU draws all at once.
  std::uint32_t rows_at_once(std::uint32_t width) const {
    constexpr std::uint64_t bytes = 64u << 20;
    constexpr double turn = std::chrono::duration<double>(turn_time).count();
    const double fit =
        static_cast<double>(bytes / (std::uint64_t{width} * (scene_.lights.size() + 1) * 16));
    const double in_time = turn / (pixel_seconds_ * width);
    return static_cast<std::uint32_t>(std::clamp(std::min(fit, in_time), 8.0, 16384.0));
  }

  /// Of a pixel, in the last region; at first that of a slow device.
  double pixel_seconds_ = 1e-6;
  const RenderScene& scene_;
  gl::Device& device_;
  std::shared_ptr<const gl::Geometry> geometry_;
  std::optional<gl::Passes> renderer_;
};

}  // namespace

std::unique_ptr<ViewPicture> cpu_picture(const RenderScene& scene, cpu::EmbreeScene geometry) {
  return std::make_unique<CpuPicture>(scene, std::move(geometry));
}

Result<std::unique_ptr<ViewPicture>> gl_picture(const RenderScene& scene, const std::string& key,
                                                gl::Device& device) {
  auto geometry = device.geometry(key, scene, no_end);
  if (!geometry) return tl::unexpected(geometry.error());
  return std::make_unique<GpuPicture>(scene, device, std::move(*geometry));
}

}  // namespace metamer::worker
