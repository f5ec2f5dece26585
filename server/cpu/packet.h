#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "server/cpu/lanes.h"
#include "server/render/ray_counts.h"
#include "server/transport/gather.h"

namespace metamer::cpu {

class MediaStack;

/// Rays on their way, and where their light goes.
struct Packet {
  Vectors origin{}, direction{};  ///< Directions are unit.
  Ints active{};
  Floats throughput = metamer::broadcast(1);       ///< Product of the mirrors' weights.
  Floats travelled{};                              ///< From the eye to `hit`.
  std::array<std::uint32_t, lane_count> pixel{};   ///< Index into Workspace::gathers.
  std::array<std::uint32_t, lane_count> chain{};   ///< Of that pixel's gather.
  std::array<std::uint32_t, lane_count> seed{};    ///< Of the pixel, for what is sampled.
  std::array<std::uint32_t, lane_count> sample{};  ///< Number of the path among those of that seed.
  RayKind kind = RayKind::camera;
  bool from_eye = true;    ///< No mirror met yet.
  bool from_lens = false;  ///< Each from a point of its own of the lens.
  bool diffused = false;   ///< A surface has scattered it.
  Vectors hit{};           ///< Where the ray hit.
  Vectors point{};         ///< The same, lifted off the surface.
  /// What each ray is in, where the scene has clear objects; else null.
  const std::array<MediaStack, lane_count>* inside = nullptr;
};

/// A part of a lane's diffuse light that goes to another surface than its own.
struct TextureShare {
  unsigned lane;
  std::uint32_t surface;  ///< Of the pixel's gather.
  float weight;
};

/// A thread's working memory.
struct Workspace {
  /// A packet is traced, of these lanes.
  void add_rays(RayKind kind, Ints lanes) {
    rays[kind].rays += static_cast<unsigned>(count(lanes));
    ++rays[kind].packets;
  }

  std::vector<Gather> gathers;               ///< One for each pixel of each group of lanes.
  std::vector<TextureShare> texture_shares;  ///< Of the packet that is shaded.
  RayCounts rays;                            ///< Since it was set.
  std::uint64_t evaluations = 0;             ///< Of models, a packet each.
  std::uint64_t timed_ticks = 0;             ///< What every timed_each-th of them took.
  /// Of ray trees, since it was made: camera rays, and the weight of paths that ended too early.
  double camera_rays = 0, beyond_depth = 0, below_cutoff = 0;
};

}  // namespace metamer::cpu
