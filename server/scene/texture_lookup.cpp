#include <algorithm>
#include <cmath>

#include "server/scene/texture.h"

namespace metamer {
namespace {

/// Two neighbours along one side, and how far it is from the first to the second.
struct Between {
  std::size_t first, second;
  float fraction;
};

std::size_t wrapped(double at, std::uint32_t size, v1::Texture::Wrap wrap) {
  const double n = size;
  if (wrap == v1::Texture::CLAMP) return static_cast<std::size_t>(std::clamp(at, 0.0, n - 1));
  const double period = wrap == v1::Texture::MIRROR ? 2 * n : n;
  double place = at - period * std::floor(at / period);
  if (place >= n) place = 2 * n - 1 - place;  // of MIRROR alone, or by rounding
  return static_cast<std::size_t>(std::clamp(place, 0.0, n - 1));
}

/// `at` in 0..1 over `size` pixels, whose values hold in their middles.
Between between(float at, std::uint32_t size, v1::Texture::Wrap wrap) {
  const double place = double{at} * size - 0.5, first = std::floor(place);
  return {wrapped(first, size, wrap), wrapped(first + 1, size, wrap),
          static_cast<float>(place - first)};
}

void add_level(const TexturePicture& picture, std::size_t index, v1::Texture::Wrap wrap, float u,
               float v, float share, float* sum) {
  const TexturePicture::Level& level = picture.levels[index];
  const Between x = between(u, level.width, wrap), y = between(1 - v, level.height, wrap);
  const auto add = [&](std::size_t column, std::size_t row, float weight) {
    if (weight == 0) return;
    const std::uint16_t* const from =
        picture.weights.data() + level.first + (row * level.width + column) * picture.channels;
    for (std::uint32_t c = 0; c < picture.channels; ++c)
      sum[c] += weight * static_cast<float>(from[c]);
  };
  const float scale = share / 65535;
  add(x.first, y.first, scale * (1 - x.fraction) * (1 - y.fraction));
  add(x.second, y.first, scale * x.fraction * (1 - y.fraction));
  add(x.first, y.second, scale * (1 - x.fraction) * y.fraction);
  add(x.second, y.second, scale * x.fraction * y.fraction);
}

}  // namespace

void add_weights(const TexturePicture& picture, v1::Texture::Wrap wrap, float u, float v,
                 float level, float* sum) {
  const auto last = static_cast<float>(picture.levels.size() - 1);
  const float at = std::clamp(level, 0.0f, last), below = std::floor(at), fraction = at - below;
  add_level(picture, static_cast<std::size_t>(below), wrap, u, v, 1 - fraction, sum);
  if (fraction > 0)
    add_level(picture, static_cast<std::size_t>(below) + 1, wrap, u, v, fraction, sum);
}

}  // namespace metamer
