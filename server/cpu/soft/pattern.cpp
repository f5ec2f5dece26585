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

/// The second dimension, its first digit lowest: Pascal's triangle modulo 2, whose entry n, k is 1
/// where n has all binary digits of k (Lucas), so that it is a product over these.
std::uint32_t second(std::uint32_t x) {
  x ^= (x & 0xaaaaaaaaU) >> 1;
  x ^= (x & 0xccccccccU) >> 2;
  x ^= (x & 0xf0f0f0f0U) >> 4;
  x ^= (x & 0xff00ff00U) >> 8;
  return x ^ (x >> 16);
}

float to_unit(std::uint32_t digits) { return static_cast<float>(digits >> 8) * 0x1p-24F; }

}  // namespace

void Pattern::put(Points& point, unsigned lane) const {
  // The first dimension is the index, mirrored: as it stands its first digit is lowest.
  point.u[lane] = to_unit(mirrored(scrambled(index, hashed(seed, 1))));
  point.v[lane] = to_unit(mirrored(scrambled(second(index), hashed(seed, 2))));
}

Pattern Pattern::shuffled() const {
  return {mirrored(scrambled(mirrored(index), hashed(seed, 6))), seed};
}

}  // namespace metamer::cpu::soft
