#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <type_traits>

#include "server/models/lanes.h"

/// The models for all lanes, a group after the other.
namespace metamer::models {

/// A group's lanes of numbers, or of a struct of them.
template <class Part, class Whole>
decltype(auto) part_of(const Whole& whole, std::size_t group) {
  if constexpr (std::is_same_v<Part, Whole>) {
    return (whole);
  } else {
    static_assert(sizeof(Whole) == group_count * sizeof(Part));
    Part part;
    const char* from = reinterpret_cast<const char*>(&whole) + group * sizeof(LaneGroup);
    char* to = reinterpret_cast<char*>(&part);
#pragma GCC unroll 16
    for (std::size_t i = 0; i < sizeof part / sizeof(LaneGroup); ++i)
      std::memcpy(to + i * sizeof(LaneGroup), from + i * sizeof(Floats), sizeof(LaneGroup));
    return part;
  }
}

/// What `each(group)` gives, which is a Part, for all lanes.
template <class Whole, class Part, class Each>
Whole of_groups(Each each) {
  if constexpr (std::is_same_v<Part, Whole>) {
    return each(std::size_t{0});
  } else {
    static_assert(sizeof(Whole) == group_count * sizeof(Part));
    std::array<Part, group_count> parts;
    for (std::size_t group = 0; group < group_count; ++group) parts[group] = each(group);
    Whole whole;
    char* to = reinterpret_cast<char*>(&whole);
#pragma GCC unroll 16
    for (std::size_t i = 0; i < sizeof whole / sizeof(Floats); ++i) {
      std::array<LaneGroup, group_count> groups;
      for (std::size_t group = 0; group < group_count; ++group)
        std::memcpy(&groups[group],
                    reinterpret_cast<const char*>(&parts[group]) + i * sizeof(LaneGroup),
                    sizeof(LaneGroup));
      const Floats joined = join(groups);
      std::memcpy(to + i * sizeof(Floats), &joined, sizeof joined);
    }
    return whole;
  }
}

inline Lobes<Floats> evaluate_packet(const Reflection<float>& reflection,
                                     const Angles<Floats>& angles) {
  return of_groups<Lobes<Floats>, Lobes<LaneGroup>>([&](std::size_t group) {
    return evaluate(reflection, part_of<Angles<LaneGroup>>(angles, group));
  });
}

inline Floats ripples_of_packet(Floats height, Floats spread, float nm) {
  return of_groups<Floats, LaneGroup>([&](std::size_t group) {
    return ripples(part_of<LaneGroup>(height, group), part_of<LaneGroup>(spread, group), nm);
  });
}

}  // namespace metamer::models
