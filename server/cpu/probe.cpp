#include "server/cpu/probe.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "server/cpu/look.h"
#include "server/cpu/tracer.h"
#include "server/render/thread_time.h"

namespace metamer::cpu {
namespace {

double fraction(double value) { return value - std::floor(value); }

/// G. L. Steele, D. Lea and C. H. Flood (2014): the k-th number of SplitMix64.
std::uint64_t random_bits(std::uint64_t k) {
  std::uint64_t z = (k + 1) * 0x9e3779b97f4a7c15;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

struct Place {
  std::uint32_t x, y;
};

Place even_place(std::uint32_t k, const v1::Plan& plan) {
  const auto along = [k](double alpha, std::uint32_t size) {
    return std::min(static_cast<std::uint32_t>(fraction(0.5 + (k + 1) * alpha) * size), size - 1);
  };
  return {along(0.7548776662466927, plan.width()), along(0.5698402909980532, plan.height())};
}

Place random_place(std::uint32_t k, const v1::Plan& plan) {
  const std::uint64_t pixels = std::uint64_t{plan.width()} * plan.height();  // below 2^32
  const std::uint64_t pixel = (random_bits(k) >> 32) * pixels >> 32;
  return {static_cast<std::uint32_t>(pixel % plan.width()),
          static_cast<std::uint32_t>(pixel / plan.width())};
}

}  // namespace

bool Geometry::prepare(const std::atomic<bool>& cancelled) {
  if (embree_) return true;
  tbb::task_arena arena(static_cast<int>(threads_));
  arena.execute([&] { embree_ = EmbreeScene::build(scene_, cancelled); });
  return embree_.has_value();
}

TracedPixels TracingProbe::trace(const v1::Plan& plan, PixelRun run,
                                 const std::atomic<bool>& stopped,
                                 std::atomic<std::uint64_t>& work) const {
  Tracer::Frame frame =
      Tracer::frame_of(plan, plan.width(), plan.height(), sample_pattern(plan.spp()));
  frame.seed = run.seed;
  const Tracer tracer(geometry_->scene(), geometry_->embree(), frame);
  auto workspace = tracer.make_workspace();
  TracedPixels pixels;
  const std::uint32_t step = run.random ? 1 : tracer.block_pixels(), end = run.first + run.count;
  // The blocks of the pixels from k on, as many as a packet takes; the next k is behind them.
  std::vector<Tracer::BlockCorner> blocks;
  std::vector<std::uint32_t> places;  // of each block its pixel at k
  const auto gather = [&](std::uint32_t& k) {
    blocks.clear();
    places.clear();
    for (; k < end && blocks.size() < group_count; k += step) {
      const Place at = run.random ? random_place(k, plan) : even_place(k, plan);
      const std::uint32_t across = at.x % tracer.block_width(), down = at.y % tracer.block_height();
      blocks.push_back({at.x - across, at.y - down});
      places.push_back(down * tracer.block_width() + across);
    }
    tracer.gather_blocks(blocks, workspace);
  };
  // Neighbours find what they need in the caches; pixels far from each other do on a second round.
  double first_round = std::numeric_limits<double>::infinity();
  if (!run.random) {
    const double start = thread_seconds();
    for (std::uint32_t k = run.first; k < end && !stopped;) gather(k);
    first_round = thread_seconds() - start;
  }
  workspace.rays = {};
  std::size_t traced = 0;
  const double start = thread_seconds();
  for (std::uint32_t k = run.first; k < end && !stopped;) {
    gather(k);
    for (std::uint32_t i = 0; i < blocks.size() * tracer.block_pixels(); ++i) {
      const auto [x, y] = blocks[i / tracer.block_pixels()];
      const std::uint32_t pixel = i % tracer.block_pixels();
      if (x + pixel % tracer.block_width() >= plan.width() ||
          y + pixel / tracer.block_width() >= plan.height())
        continue;
      ++traced;
      // The others of a block were not drawn at random.
      if (!run.random || pixel == places[i / tracer.block_pixels()])
        pixels.gathers.push_back(workspace.gathers[i]);
    }
    work += blocks.size();
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, traced));
  pixels.seconds = std::min(first_round, thread_seconds() - start) / count;
  pixels.rays = static_cast<double>(workspace.rays.rays()) / count;
  return pixels;
}

std::optional<SeenPoint> TracingProbe::look(const v1::Plan& plan, std::uint32_t x,
                                            std::uint32_t y) const {
  return cpu::look(geometry_->scene(), geometry_->embree(), plan, x, y);
}

double TracingProbe::picture_seconds(const v1::Plan& plan, const Method&, double pixel_seconds,
                                     const std::atomic<bool>&, std::atomic<std::uint64_t>&) {
  return pixel_seconds * plan.width() * plan.height() / std::max(1u, plan.threads());
}

}  // namespace metamer::cpu
