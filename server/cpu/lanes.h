#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstring>

/// Eight rays at a time: vectors of eight numbers and what the tracer does with them.
namespace metamer {

inline constexpr int lane_count = 8;

using Float8 = float __attribute__((vector_size(32)));
using Int8 = int __attribute__((vector_size(32)));  ///< Also a mask: -1 true, 0 false.

/// Eight points or directions.
struct Vec8 {
  Float8 x, y, z;
};

inline Float8 broadcast(float value) { return Float8{} + value; }
inline Vec8 broadcast(const std::array<float, 3>& v) {
  return {broadcast(v[0]), broadcast(v[1]), broadcast(v[2])};
}
inline Vec8 to_lanes(const Eigen::Vector3d& v) {
  return {broadcast(static_cast<float>(v.x())), broadcast(static_cast<float>(v.y())),
          broadcast(static_cast<float>(v.z()))};
}

inline Vec8 operator+(const Vec8& a, const Vec8& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec8 operator-(const Vec8& a, const Vec8& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec8 operator*(const Vec8& a, Float8 s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec8 operator/(const Vec8& a, Float8 s) { return {a.x / s, a.y / s, a.z / s}; }
inline Float8 dot(const Vec8& a, const Vec8& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

inline Float8 select(Int8 mask, Float8 yes, Float8 no) { return mask ? yes : no; }
inline Vec8 select(Int8 mask, const Vec8& yes, const Vec8& no) {
  return {select(mask, yes.x, no.x), select(mask, yes.y, no.y), select(mask, yes.z, no.z)};
}
inline Float8 max(Float8 a, Float8 b) { return a > b ? a : b; }
inline Float8 min(Float8 a, Float8 b) { return a < b ? a : b; }
inline Float8 abs(Float8 a) { return max(a, -a); }

inline Float8 sqrt(Float8 a) {
  Float8 root;
  for (int i = 0; i < lane_count; ++i) root[i] = std::sqrt(a[i]);
  return root;
}

inline bool any(Int8 mask) {
  int all = 0;
  for (int i = 0; i < lane_count; ++i) all |= mask[i];
  return all != 0;
}

inline int count(Int8 mask) {
  int n = 0;
  for (int i = 0; i < lane_count; ++i) n -= mask[i];
  return n;
}

/// The sum of eight lanes, by halves: always in the same order.
inline float sum(Float8 a) {
  using Float4 = float __attribute__((vector_size(16)));
  const Float4 halves =
      __builtin_shufflevector(a, a, 0, 1, 2, 3) + __builtin_shufflevector(a, a, 4, 5, 6, 7);
  return (halves[0] + halves[2]) + (halves[1] + halves[3]);
}

/// Moves lanes to and from Embree's aligned arrays of eight.
inline void store(float* to, Float8 from) { std::memcpy(to, &from, sizeof from); }
inline void store(int* to, Int8 from) { std::memcpy(to, &from, sizeof from); }
inline Float8 load(const float* from) {
  Float8 to;
  std::memcpy(&to, from, sizeof to);
  return to;
}
inline Int8 load(const unsigned* from) {
  Int8 to;
  std::memcpy(&to, from, sizeof to);
  return to;
}

}  // namespace metamer
