#include "server/cpu/soft/pattern.h"

namespace metamer::cpu::soft {
namespace {

std::uint32_t mirrored(std::uint32_t x) {
  x = (x >> 16) | (x << 16);
  x = ((x & 0x00ff00ffU) << 8) | ((x & 0xff00ff00U) >> 8);
  x = ((x & 0x0f0f0f0fU) << 4) | ((x & 0xf0f0f0f0U) >> 4);
  x = ((x & 0x33333333U) << 2) | ((x & 0xccccccccU) >> 2);
  return ((x & 0x55555555U) << 1) | ((x & 0xaaaaaaaaU) >> 1);
}

/// Flips each binary digit by what those before it are. `x` has the first digit lowest.
std::uint32_t scrambled(std::uint32_t x, std::uint32_t seed) {
  x ^= x * 0x3d20adeaU;
  x += seed;
  x *= (seed >> 16) | 1;
  x ^= x * 0x05526c56U;
  x ^= x * 0x53a22864U;
  return x;
}

/// The second dimension, its first digit highest: direction numbers v_k = v_{k-1} ^ v_{k-1} >> 1.
std::uint32_t second(std::uint32_t index) {
  std::uint32_t x = 0;
  for (std::uint32_t v = 1U << 31; index != 0; index >>= 1, v ^= v >> 1)
    if (index & 1) x ^= v;
  return x;
}

float to_unit(std::uint32_t digits) { return static_cast<float>(digits >> 8) * 0x1p-24F; }

}  // namespace

void Pattern::put(Point8& point, unsigned lane) const {
  // The first dimension is the index, mirrored: as it stands its first digit is lowest.
  point.u[lane] = to_unit(mirrored(scrambled(index, hashed(seed, 1))));
  point.v[lane] = to_unit(mirrored(scrambled(mirrored(second(index)), hashed(seed, 2))));
}

Pattern Pattern::shuffled() const {
  return {mirrored(scrambled(mirrored(index), hashed(seed, 6))), seed};
}

}  // namespace metamer::cpu::soft
