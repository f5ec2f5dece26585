#pragma once

#include <Eigen/Core>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#ifdef __AVX__
#  include <immintrin.h>
#endif

/// Several rays at a time: vectors of numbers, one a lane, and what the tracer does with them. How
/// many is METAMER_LANES: 8, or 16 in the build for x86-64-v4.
namespace metamer {

#ifndef METAMER_LANES
#  define METAMER_LANES 8
#endif

inline constexpr int lane_count = METAMER_LANES;
/// Lanes come in groups of eight, however many they are. What is summed or decided for several
/// lanes is so for those of a group: then a picture's bits do not depend on the number of lanes.
inline constexpr int group_size = 8, group_count = lane_count / group_size;
static_assert(group_count > 0 && lane_count % group_size == 0);

using Floats = float __attribute__((vector_size(4 * lane_count)));
using Ints = int __attribute__((vector_size(4 * lane_count)));  ///< Also a mask: -1 true, 0 false.

/// A group's lanes.
using LaneGroup = float __attribute__((vector_size(4 * group_size)));

/// Points or directions.
struct Vectors {
  Floats x, y, z;
};

inline Floats broadcast(float value) { return Floats{} + value; }
inline Vectors broadcast(const std::array<float, 3>& v) {
  return {broadcast(v[0]), broadcast(v[1]), broadcast(v[2])};
}
inline Vectors to_lanes(const Eigen::Vector3d& v) {
  return {broadcast(static_cast<float>(v.x())), broadcast(static_cast<float>(v.y())),
          broadcast(static_cast<float>(v.z()))};
}

inline Vectors operator+(const Vectors& a, const Vectors& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vectors operator-(const Vectors& a, const Vectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vectors operator*(const Vectors& a, Floats s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vectors operator/(const Vectors& a, Floats s) { return {a.x / s, a.y / s, a.z / s}; }
inline Floats dot(const Vectors& a, const Vectors& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline Floats select(Ints mask, Floats yes, Floats no) { return mask ? yes : no; }
inline Vectors select(Ints mask, const Vectors& yes, const Vectors& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}
inline Floats max(Floats a, Floats b) { return a > b ? a : b; }
inline Floats min(Floats a, Floats b) { return a < b ? a : b; }
inline Floats abs(Floats a) { return max(a, -a); }

inline Floats sqrt(Floats a) {
#if METAMER_LANES == 16 && defined(__AVX512F__)
  return _mm512_maskz_sqrt_ps(0xffff, a);  // GCC 12 warns wrongly of the one without a mask
#elif METAMER_LANES == 8 && defined(__AVX__)
  return _mm256_sqrt_ps(a);
#else
  Floats root{};
  for (int i = 0; i < lane_count; ++i) root[i] = std::sqrt(a[i]);
  return root;
#endif
}

/// A bit for each lane of a mask.
inline unsigned bits(Ints mask) {
#if METAMER_LANES == 16 && defined(__AVX512DQ__)
  return _mm512_movepi32_mask(reinterpret_cast<__m512i>(mask));
#elif METAMER_LANES == 8 && defined(__AVX__)
  return static_cast<unsigned>(_mm256_movemask_ps(reinterpret_cast<__m256>(mask)));
#else
  unsigned bits = 0;
  for (unsigned i = 0; i < lane_count; ++i) bits |= (mask[i] != 0 ? 1U : 0U) << i;
  return bits;
#endif
}

inline bool any(Ints mask) { return bits(mask) != 0; }

/// Any of a group's lanes.
inline bool any_of(Ints mask, unsigned group) {
  return (bits(mask) >> group * group_size & ((1U << group_size) - 1)) != 0;
}

inline int count(Ints mask) { return std::popcount(bits(mask)); }

/// The lanes of a group, as a mask.
inline Ints lanes_of(unsigned group) {
  Ints number{};
  for (int i = 0; i < lane_count; ++i) number[i] = i / group_size;
  return number == static_cast<int>(group);
}

/// All lanes of the groups.
inline Floats join(const std::array<LaneGroup, group_count>& groups) {
#if METAMER_LANES == 16
  return __builtin_shufflevector(groups[0], groups[1], 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13,
                                 14, 15);
#else
  Floats all;
  std::memcpy(&all, &groups, sizeof all);
  return all;
#endif
}

/// The sum of a group's lanes, by halves: always in the same order.
inline float sum(Floats a, unsigned group) {
  using Half = float __attribute__((vector_size(4 * group_size / 2)));
  std::array<Half, 2 * group_count> halves;
  std::memcpy(&halves, &a, sizeof a);
  const Half both = halves[2 * group] + halves[2 * group + 1];
  return (both[0] + both[2]) + (both[1] + both[3]);
}

/// Moves lanes to and from Embree's aligned arrays.
inline void store(float* to, Floats from) { std::memcpy(to, &from, sizeof from); }
inline void store(int* to, Ints from) { std::memcpy(to, &from, sizeof from); }
inline Floats load(const float* from) {
  Floats to;
  std::memcpy(&to, from, sizeof to);
  return to;
}
inline Ints load(const unsigned* from) {
  Ints to;
  std::memcpy(&to, from, sizeof to);
  return to;
}

}  // namespace metamer
