#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace metamer {

/// What a ray is sent for. "Transmitted": refracted, or on through what is not all there;
/// "diffuse": to where a surface's light comes from that is no light's own.
enum class RayKind { camera, mirror, transmitted, shadow, diffuse };
/// As in RunRecord, by RayKind.
inline constexpr std::array<const char*, 5> ray_kind_names = {"camera", "mirror", "transmitted",
                                                              "shadow", "diffuse"};

/// Rays and the packets that they were traced in: so many lanes of each were active in the mean.
struct RayCount {
  std::uint64_t rays = 0, packets = 0;
};

/// By RayKind.
struct RayCounts {
  std::array<RayCount, ray_kind_names.size()> of{};

  RayCount& operator[](RayKind kind) { return of[static_cast<std::size_t>(kind)]; }
  std::uint64_t rays() const {
    std::uint64_t sum = 0;
    for (const RayCount& one : of) sum += one.rays;
    return sum;
  }
  RayCounts& operator+=(const RayCounts& other) {
    for (std::size_t i = 0; i < of.size(); ++i) {
      of[i].rays += other.of[i].rays;
      of[i].packets += other.of[i].packets;
    }
    return *this;
  }
};

}  // namespace metamer
