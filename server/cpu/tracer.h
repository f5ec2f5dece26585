#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "metamer/v1/plan.pb.h"
#include "server/cpu/embree_scene.h"
#include "server/cpu/lens.h"
#include "server/cpu/media.h"
#include "server/cpu/ray_tree.h"
#include "server/cpu/shading.h"
#include "server/film/pixel_sink.h"
#include "server/film/sample_pattern.h"

namespace metamer::cpu {

/// Traces rays in packets, which Shading turns into weights; knows nothing of spectra. A packet's
/// group of eight lanes belongs to one pixel, or, where its samples fill no groups by themselves,
/// to a small block of pixels at a fixed place of the picture; what it makes of it does not depend
/// on the other group. So the result depends on neither tiles nor threads nor the number of lanes.
/// Immutable, shared by threads.
class Tracer {
 public:
  /// What is traced, from the scene's camera.
  struct Frame {
    std::uint32_t width, height;       ///< Pixels.
    std::uint32_t depth;               ///< Mirrors that a path may meet.
    std::vector<SamplePoint> samples;  ///< Of each pixel; at least one.
    float cutoff = 1e-3f;              ///< Of paths over clear surfaces.
    std::uint32_t light_samples = 1;   ///< Of each light with a surface and of the environment.
    Diffusion diffusion = {};
    std::uint32_t seed = 0;  ///< Another one: other points of lights and lens, other ways.
    bool lens = true;        ///< The camera's; without it, all rays are from its middle.
  };
  static Frame frame_of(const v1::Plan& plan, std::uint32_t width, std::uint32_t height,
                        std::vector<SamplePoint> samples);

  /// The references must outlive the tracer.
  Tracer(const RenderScene& scene, const EmbreeScene& geometry, const Frame& frame);
  Tracer(const RenderScene& scene, const EmbreeScene& geometry, const v1::Plan& plan);

  Tracer(const Tracer&) = delete;  // its parts refer to each other

  /// A thread's working memory.
  using Workspace = cpu::Workspace;
  Workspace make_workspace() const;

  /// Traces the pixels of `tile`, whose corner lies on multiples of 8, and gives each to `sink`.
  /// Looks at `cancelled` before each row of blocks and then leaves the rest out; `work` counts
  /// pixels.
  void render(const Rect& tile, PixelSink& sink, Workspace& workspace,
              const std::atomic<bool>& cancelled, std::atomic<std::uint64_t>& work) const;

  /// Pixels that share groups of lanes; a block's corner lies on multiples of its sides.
  std::uint32_t block_width() const { return block_width_; }
  std::uint32_t block_height() const { return block_height_; }
  std::uint32_t block_pixels() const { return block_width_ * block_height_; }
  /// Where a block begins, in pixels.
  struct BlockCorner {
    std::uint32_t x, y;
  };
  /// Traces some blocks, up to group_count: what their pixels receive is in `workspace.gathers`
  /// then, block by block and row by row; that of pixels outside the picture is empty.
  void gather_blocks(std::span<const BlockCorner> corners, Workspace& workspace) const;

 private:
  /// Samples of a packet, alike in each group, from its block's corner in pixels.
  struct Samples {
    Floats x{}, y{};
    Ints active{};
    std::array<std::uint32_t, lane_count> pixel{};   ///< Of the blocks, row by row.
    std::array<std::uint32_t, lane_count> number{};  ///< SamplePoint::number.
  };

  void prepare_samples(const std::vector<SamplePoint>& pattern);
  void trace(Packet& packet, Workspace& workspace) const;
  void reflect(Packet& packet, const Hits& hits, Workspace& workspace) const;

  const RenderScene& scene_;
  const EmbreeScene& geometry_;
  Cutouts cutouts_;
  std::optional<Media> media_;  ///< Where rays split.
  Shading shading_;
  std::optional<RayTree> tree_;
  unsigned depth_;
  std::uint32_t width_, height_;
  std::uint32_t seed_;
  bool is_sampled_;  ///< Some light is looked at by points or ways that are chosen.
  std::uint32_t block_width_, block_height_;  ///< Pixels whose samples fill groups.
  std::vector<Samples> samples_;              ///< Of one block.
  std::optional<Lens> lens_;                  ///< Of a camera that is no pinhole.
  Vectors eye_, corner_, across_,
      down_;  ///< Direction = corner + x across + y down, x and y in pixels.
};

}  // namespace metamer::cpu
