#include "server/worker/view_picture.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>

#include "server/cpu/tracer.h"
#include "server/film/pixel_sink.h"
#include "server/gl/device.h"
#include "server/gl/renderer.h"

namespace metamer {
namespace {

const std::atomic<bool> never = false;

class CpuPicture : public ViewPicture {
 public:
  CpuPicture(const RenderScene& scene, cpu::EmbreeScene geometry)
      : scene_(scene), geometry_(std::move(geometry)) {}

  Result<void> change(const v1::Plan& plan, const Method& method) override {
    plan_ = &plan;
    method_ = &method;
    return {};
  }

  Result<void> draw(const Film& film, std::span<const SamplePoint> samples,
                    const std::atomic<bool>& cancelled, Work& work) override {
    const cpu::Tracer tracer(
        scene_, geometry_,
        cpu::Tracer::Frame{
            film.width, film.height, plan_->depth(), {samples.begin(), samples.end()}});
    constexpr std::uint32_t side = 32;
    const std::uint32_t columns = (film.width + side - 1) / side;
    const std::uint32_t tiles = columns * ((film.height + side - 1) / side);
    std::atomic<std::uint32_t> next = 0;
    tbb::task_arena arena(static_cast<int>(plan_->threads()));
    arena.execute([&] {
      tbb::parallel_for(0u, plan_->threads(), [&](unsigned) {
        cpu::Tracer::Workspace workspace = tracer.make_workspace();
        FilmSink sink(*method_, film, static_cast<std::uint32_t>(samples.size()));
        for (std::uint32_t i = next++; i < tiles && !cancelled; i = next++) {
          const std::uint32_t x = i % columns * side, y = i / columns * side;
          tracer.render({x, y, std::min(side, film.width - x), std::min(side, film.height - y)},
                        sink, workspace, cancelled, work);
        }
      });
    });
    return {};
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
    auto renderer = gl::Renderer::create(scene_, *geometry_, plan, method, device_.programs(),
                                         device_.capabilities().timers());
    if (!renderer) return tl::unexpected(renderer.error());
    renderer_.emplace(std::move(*renderer));
    return {};
  }

  Result<void> draw(const Film& film, std::span<const SamplePoint> samples,
                    const std::atomic<bool>& cancelled, Work& work) override {
    const std::uint32_t rows = rows_at_once(film.width);
    for (std::uint32_t y = 0; y < film.height; y += rows) {
      const Rect region{0, y, film.width, std::min(rows, film.height - y)};
      if (auto done = renderer_->render(region, film, samples, cancelled, work); !done) return done;
    }
    return {};
  }

 private:
  /// As many as fit into this memory with what their pixels gather of each light: mostly all.
  std::uint32_t rows_at_once(std::uint32_t width) const {
    constexpr std::uint64_t bytes = 64u << 20;
    const std::uint64_t row = std::uint64_t{width} * (scene_.lights.size() + 1) * 16;
    return static_cast<std::uint32_t>(std::max<std::uint64_t>(8, bytes / row));
  }

  const RenderScene& scene_;
  gl::Device& device_;
  std::shared_ptr<const gl::Geometry> geometry_;
  std::optional<gl::Renderer> renderer_;
};

}  // namespace

Result<std::unique_ptr<ViewPicture>> ViewPicture::make(const RenderScene& scene,
                                                       const std::string& key,
                                                       const WorkerOptions& options) {
  if (!options.gl)
    return std::make_unique<CpuPicture>(scene, *cpu::EmbreeScene::build(scene, never));
  auto geometry = options.gl->geometry(key, scene, never);
  if (!geometry) return tl::unexpected(geometry.error());
  return std::make_unique<GpuPicture>(scene, *options.gl, std::move(*geometry));
}

}  // namespace metamer
