#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "server/cpu/lanes.h"
#include "server/transport/gather.h"

namespace metamer::cpu {

class MediaStack;

/// Eight rays on their way, and where their light goes.
struct Packet {
  Vec8 origin{}, direction{};  ///< Directions are unit.
  Int8 active{};
  Float8 throughput = metamer::broadcast(1);  ///< Product of the mirrors' weights.
  Float8 travelled{};                         ///< From the eye to `hit`.
  std::array<std::uint32_t, 8> pixel{};       ///< Index into Workspace::gathers.
  std::array<std::uint32_t, 8> chain{};       ///< Of that pixel's gather.
  std::array<std::uint32_t, 8> seed{};        ///< Of the pixel, for what is sampled.
  std::array<std::uint32_t, 8> sample{};      ///< Number of the path among those of that seed.
  bool from_eye = true;                       ///< No mirror met yet.
  bool from_lens = false;                     ///< Each from a point of its own of the lens.
  bool diffused = false;                      ///< A surface has scattered it.
  Vec8 hit{};                                 ///< Where the ray hit.
  Vec8 point{};                               ///< The same, lifted off the surface.
  /// What each ray is in, where the scene has clear objects; else null.
  const std::array<MediaStack, 8>* inside = nullptr;
};

/// A part of a lane's diffuse light that goes to another surface than its own.
struct TextureShare {
  unsigned lane;
  std::uint32_t surface;  ///< Of the pixel's gather.
  float weight;
};

/// A thread's working memory.
struct Workspace {
  std::vector<Gather> gathers;               ///< One for each pixel of a block.
  std::vector<TextureShare> texture_shares;  ///< Of the packet that is shaded.
  std::uint64_t rays = 0;                    ///< Camera, mirror and shadow rays since it was set.
  std::uint64_t evaluations = 0;             ///< Of models, eight points each.
  std::uint64_t timed_ticks = 0;             ///< What every timed_each-th of them took.
  /// Of ray trees, since it was made: camera rays, and the weight of paths that ended too early.
  double camera_rays = 0, beyond_depth = 0, below_cutoff = 0;
};

}  // namespace metamer::cpu
