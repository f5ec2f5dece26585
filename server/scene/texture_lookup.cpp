#include <algorithm>
#include <cmath>
#include <numbers>

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
  if (!std::isfinite(place)) return {0, 0, 0};  // UVs times their scale are beyond f32
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

std::array<std::array<float, 3>, 2> uv_map(const v1::Texture& texture) {
  const double su = texture.has_scale() ? texture.scale().u() : 1,
               sv = texture.has_scale() ? texture.scale().v() : 1,
               angle = texture.rotation() * std::numbers::pi / 180, c = std::cos(angle),
               s = std::sin(angle);
  const auto row = [](double a, double b, double d) {
    return std::array<float, 3>{static_cast<float>(a), static_cast<float>(b),
                                static_cast<float>(d)};
  };
  return {row(c * su, -s * sv, texture.offset().u()), row(s * su, c * sv, texture.offset().v())};
}

}  // namespace

PlacedPicture::PlacedPicture(TexturePicture of, const v1::Texture& texture)
    : picture(std::move(of)), wrap(texture.wrap()), map(uv_map(texture)) {
  // The root of the pixels that a unit square of a surface's UVs has.
  const TexturePicture::Level& finest = picture.levels.front();
  const double area = double{map[0][0]} * map[1][1] - double{map[0][1]} * map[1][0];
  pixels_per_uv = static_cast<float>(std::sqrt(std::abs(area) * finest.width * finest.height));
}

float PlacedPicture::level(float covered, float slant) const {
  return std::log2(covered * pixels_per_uv / slant);
}

void add_weights(const TexturePicture& picture, v1::Texture::Wrap wrap, float u, float v,
                 float level, float* sum) {
  const auto last = static_cast<float>(picture.levels.size() - 1);
  const float at = level > 0 ? std::min(level, last) : 0.0f;  // also of a NaN
  const float below = std::floor(at), fraction = at - below;
  add_level(picture, static_cast<std::size_t>(below), wrap, u, v, 1 - fraction, sum);
  if (fraction > 0)
    add_level(picture, static_cast<std::size_t>(below) + 1, wrap, u, v, fraction, sum);
}

}  // namespace metamer
