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
/// Of a part of a tile: the smallest that the tracer takes, since a pixel may have 1,024 samples.
constexpr std::uint32_t part_side = 8;

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
    shares_.clear();
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
    next_ = whole_ = 0;
    shares_.clear();
    shares_.resize(plan_->threads());
    tracer_.emplace(
        scene_, geometry_->embree(),
        Tracer::frame_of(*plan_, picture_.film.width, picture_.film.height, picture_.samples));
  }

  /// Each thread takes the next tile, so that they are begun in the order that was asked for.
  Result<bool> draw(const Control& control) override {
    tbb::task_arena arena(static_cast<int>(plan_->threads()));
    arena.execute([&] {
      tbb::parallel_for(0u, plan_->threads(), [&](unsigned i) { draw_tiles(i, control); });
    });
    return whole_ == picture_.tiles.size() && !control.cancelled;
  }

  void report(v1::Timing& timing) override {
    timing.set_models(static_cast<double>(model_ticks_) /
                      static_cast<double>(std::max<std::uint64_t>(ticks_, 1)));
    double rays = 0, beyond_depth = 0, below_cutoff = 0;
    for (const auto& share : shares_) {
      if (!share) continue;
      rays += share->workspace.camera_rays;
      beyond_depth += share->workspace.beyond_depth;
      below_cutoff += share->workspace.below_cutoff;
    }
    timing.set_beyond_depth(beyond_depth / std::max(rays, 1.0));
    timing.set_below_cutoff(below_cutoff / std::max(rays, 1.0));
  }

  RayCounts rays() const override {
    RayCounts rays;
    for (const auto& share : shares_)
      if (share) rays += share->rays;
    return rays;
  }

  std::unique_ptr<Probe> make_probe() override { return std::make_unique<TracingProbe>(geometry_); }

 private:
  /// One thread's work on tiles, which goes on in its next turn.
  struct Share {
    Workspace workspace;
    FilmSink film;
    std::optional<FactorSink> factors;
    std::optional<Rect> tile;  ///< That has been taken and is not whole.
    std::uint32_t next_part = 0;
    RayCounts rays;  ///< Of its whole tiles.
  };

  Share& share(unsigned index) {
    auto& share = shares_[index];
    if (share) return *share;
    const auto spp = static_cast<std::uint32_t>(picture_.samples.size());
    share.reset(new Share{
        tracer_->make_workspace(), FilmSink(*method_, picture_.film, spp), {}, {}, 0, {}});
    if (picture_.keep_factors) share->factors.emplace(share->film, spp);
    return *share;
  }

  /// At least one part of a tile, where there are any.
  void draw_tiles(unsigned index, const Control& control) {
    Share& own = share(index);
    const std::uint64_t start = ticks();
    const std::uint64_t model_start = model_ticks(own.workspace);
    do {
      if (!own.tile && !take_tile(own)) break;
      draw_part(own, control);
      if (control.cancelled) return;
    } while (!control.is_over());
    ticks_ += ticks() - start;
    model_ticks_ += model_ticks(own.workspace) - model_start;
  }

  bool take_tile(Share& own) {
    const std::size_t i = next_++;
    if (i >= picture_.tiles.size()) return false;
    own.tile = picture_.tiles[i];
    own.next_part = 0;
    own.workspace.rays = {};
    if (own.factors) own.factors->begin(*own.tile);
    return true;
  }

  /// Others have their turn between two parts, however large a tile and whatever its samples are.
  void draw_part(Share& own, const Control& control) {
    const Rect tile = *own.tile;
    const std::uint32_t columns = (tile.width - 1) / part_side + 1;
    const std::uint32_t rows = (tile.height - 1) / part_side + 1;
    const std::uint32_t x = own.next_part % columns * part_side;
    const std::uint32_t y = own.next_part / columns * part_side;
    const Rect part = {tile.x + x, tile.y + y, std::min(part_side, tile.width - x),
                       std::min(part_side, tile.height - y)};
    tracer_->render(part, own.factors ? static_cast<PixelSink&>(*own.factors) : own.film,
                    own.workspace, control.cancelled, control.work);
    if (control.cancelled || ++own.next_part < columns * rows) return;
    own.tile.reset();
    own.rays += own.workspace.rays;
    ++whole_;
    if (!picture_.tile_done) return;
    std::optional<v1::TileFactors> kept;
    if (own.factors) kept = own.factors->finish();
    picture_.tile_done({tile, own.workspace.rays.rays(), kept ? &*kept : nullptr});
  }

  const RenderScene& scene_;
  std::shared_ptr<Geometry> geometry_;
  const v1::Plan* plan_ = nullptr;
  const Method* method_ = nullptr;
  Picture picture_;
  std::optional<Tracer> tracer_;
  std::vector<std::unique_ptr<Share>> shares_;  ///< By thread; made when it first has a turn.
  std::atomic<std::size_t> next_ = 0;           ///< Tiles before it have been taken.
  std::atomic<std::size_t> whole_ = 0;          ///< So many of them are.
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

std::unique_ptr<Backend> make_backend(unsigned threads, Lanes<lane_count>) {
  return std::make_unique<RayTracing>(threads);
}

}  // namespace metamer::cpu
