#include "server/cpu/renderer.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <optional>

#include "server/cpu/probe.h"
#include "server/cpu/ticks.h"
#include "server/cpu/tracer.h"
#include "server/film/factor_sink.h"
#include "server/film/pixel_sink.h"

namespace metamer::cpu {
namespace {

/// Of a whole film, where nobody asked for tiles.
constexpr std::uint32_t tile_side = 16;

std::vector<Rect> tiles_of(const Film& film) {
  std::vector<Rect> tiles;
  for (std::uint32_t y = 0; y < film.height; y += tile_side)
    for (std::uint32_t x = 0; x < film.width; x += tile_side)
      tiles.push_back(
          {x, y, std::min(tile_side, film.width - x), std::min(tile_side, film.height - y)});
  return tiles;
}

class RayTracer : public Renderer {
 public:
  RayTracer(const RenderScene& scene, unsigned threads)
      : scene_(scene), geometry_(std::make_shared<Geometry>(scene, threads)) {}

  bool prepare(const std::atomic<bool>& cancelled) override {
    return geometry_->prepare(cancelled);
  }

  Result<void> change(const v1::Plan& plan, const Method& method,
                      const std::atomic<bool>& cancelled) override {
    tracer_.reset();
    if (!prepare(cancelled)) return problem("");
    plan_ = &plan;
    method_ = &method;
    return {};
  }

  void begin(Picture picture) override {
    picture_ = std::move(picture);
    if (picture_.tiles.empty()) {
      picture_.tiles = tiles_of(picture_.film);
      picture_.tile_done = {};
    }
    next_ = 0;
    tracer_.emplace(
        scene_, geometry_->embree(),
        Tracer::Frame{picture_.film.width, picture_.film.height, plan_->depth(), picture_.samples});
  }

  /// Each thread takes the next tile, so that they are begun in the order that was asked for.
  Result<bool> draw(const Control& control) override {
    tbb::task_arena arena(static_cast<int>(plan_->threads()));
    arena.execute(
        [&] { tbb::parallel_for(0u, plan_->threads(), [&](unsigned) { draw_tiles(control); }); });
    // Who has taken a tile has drawn it.
    return next_ >= picture_.tiles.size() && !control.cancelled;
  }

  void report(v1::Timing& timing) override {
    timing.set_models(static_cast<double>(model_ticks_) /
                      static_cast<double>(std::max<std::uint64_t>(ticks_, 1)));
  }

  std::unique_ptr<Probe> make_probe() override { return std::make_unique<TracingProbe>(geometry_); }

 private:
  /// At least one, where there are any.
  void draw_tiles(const Control& control) {
    Workspace workspace = tracer_->make_workspace();
    const auto spp = static_cast<std::uint32_t>(picture_.samples.size());
    FilmSink film(*method_, picture_.film, spp);
    std::optional<FactorSink> factors;
    if (picture_.keep_factors) factors.emplace(film, spp);
    const std::uint64_t start = ticks();
    do {
      const std::size_t i = next_++;
      if (i >= picture_.tiles.size() || control.cancelled) break;
      const Rect& tile = picture_.tiles[i];
      workspace.rays = 0;
      if (factors) factors->begin(tile);
      tracer_->render(tile, factors ? static_cast<PixelSink&>(*factors) : film, workspace,
                      control.cancelled, control.work);
      if (control.cancelled) return;
      if (!picture_.tile_done) continue;
      std::optional<v1::TileFactors> kept;
      if (factors) kept = factors->finish();
      picture_.tile_done({tile, workspace.rays, kept ? &*kept : nullptr});
    } while (!control.is_over());
    ticks_ += ticks() - start;
    model_ticks_ += model_ticks(workspace);
  }

  const RenderScene& scene_;
  std::shared_ptr<Geometry> geometry_;
  const v1::Plan* plan_ = nullptr;
  const Method* method_ = nullptr;
  Picture picture_;
  std::optional<Tracer> tracer_;
  std::atomic<std::size_t> next_ = 0;  ///< Tiles before it have been taken.
  std::atomic<std::uint64_t> ticks_ = 0, model_ticks_ = 0;
};

class RayTracing : public Backend {
 public:
  explicit RayTracing(unsigned threads) : threads_(threads) {}

  v1::Backend id() const override { return v1::CPU; }
  std::string name() const override { return "cpu"; }
  Features features() const override { return cpu::features; }
  void describe(v1::Capabilities&) const override {}
  Result<void> enter() override { return {}; }
  bool is_sound() const override { return true; }
  std::unique_ptr<Renderer> make_renderer(const RenderScene& scene,
                                          const std::string&) const override {
    return std::make_unique<RayTracer>(scene, threads_);
  }

 private:
  unsigned threads_;
};

}  // namespace

std::unique_ptr<Backend> make_backend(unsigned threads) {
  return std::make_unique<RayTracing>(threads);
}

}  // namespace metamer::cpu
