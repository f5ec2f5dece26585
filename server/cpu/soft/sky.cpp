#include "server/cpu/soft/sky.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace metamer::cpu::soft {
namespace {

constexpr float two_pi = 2 * std::numbers::pi_v<float>;
using Direction = std::array<float, 3>;

constexpr float alike = 1;  ///< In all directions.

/// (x, y, z) in the frame of a unit normal, as z; the basis of T. Duff et al., JCGT 6(1), 2017.
Direction about(const Direction& n, float x, float y, float z) {
  const float sign = std::copysign(1.0F, n[2]), a = -1 / (sign + n[2]), b = n[0] * n[1] * a;
  return {(1 + sign * n[0] * n[0] * a) * x + b * y + n[0] * z,
          sign * b * x + (sign + n[1] * n[1] * a) * y + n[1] * z,
          -sign * n[0] * x - n[1] * y + n[2] * z};
}

/// The unit vector with this cosine to the normal.
Direction about(const Direction& n, float cosine, float turn) {
  const float sine = std::sqrt(std::max(0.0F, 1 - cosine * cosine));
  return about(n, sine * std::cos(two_pi * turn), sine * std::sin(two_pi * turn), cosine);
}

}  // namespace

Sky::Sky(const RenderScene& scene)
    : first_light_(scene.environment->first_light),
      light_count_(scene.environment->light_count()),
      visible_(scene.environment->visible),
      cosine_(static_cast<float>(std::cos(scene.environment->rotation))),
      sine_(static_cast<float>(std::sin(scene.environment->rotation))),
      picture_(scene.environment->picture) {
  // What is not seen is light all the same: no sample may miss it.
  for (std::uint32_t i = 0; i < light_count_; ++i)
    luminances_.push_back(
        std::max({scene.lights[first_light_ + i].luminance, 1e-3 / light_count_, 1e-30}));
  if (!picture_) return;
  const std::uint32_t width = picture_->width, height = picture_->height;
  for (std::uint32_t y = 0; y <= height; ++y)
    edges_.push_back(static_cast<float>(std::cos(y * std::numbers::pi / height)));
  up_to_pixel_.resize(std::size_t{width} * height);
  std::vector<double> rows;
  for (std::uint32_t y = 0; y < height; ++y) {
    double row = 0;
    for (std::uint32_t x = 0; x < width; ++x) row += brightness({x, y});
    double sum = 0;
    for (std::uint32_t x = 0; x < width; ++x)
      up_to_pixel_[std::size_t{y} * width + x] =
          static_cast<float>((sum += brightness({x, y})) / (row > 0 ? row : 1));
    rows.push_back(row * double{edges_[y] - edges_[y + 1]} * 2 * std::numbers::pi / width);
    whole_ += rows.back();
  }
  double sum = 0;
  for (const double row : rows) {
    up_to_row_.push_back(static_cast<float>(sum / whole_));
    sum += row;
  }
  up_to_row_.push_back(1);
}

/// The picture stands still; directions turn the other way.
Direction Sky::turned(const Direction& d, float sine) const {
  return {cosine_ * d[0] - sine * d[2], d[1], sine * d[0] + cosine_ * d[2]};
}

Sky::Place Sky::place_of(const Direction& direction) const {
  const Direction d = turned(direction, sine_);
  const auto cell = [](float share, std::uint32_t count) {
    return std::min(static_cast<std::uint32_t>(std::max(0.0F, share) * static_cast<float>(count)),
                    count - 1);
  };
  const float polar = std::acos(std::clamp(d[1], -1.0F, 1.0F)) / std::numbers::pi_v<float>;
  return {cell(0.5F + std::atan2(d[0], -d[2]) / two_pi, picture_->width),
          cell(polar, picture_->height)};
}

const float* Sky::radiance(const Direction& direction) const {
  if (!picture_) return &alike;
  const Place place = place_of(direction);
  return picture_->at(place.x, place.y).data();
}

/// Its luminance, nearly; the choice of samples alone depends on it.
double Sky::brightness(Place place) const {
  const std::span<const float> values = picture_->at(place.x, place.y);
  double sum = 0;
  for (std::size_t i = 0; i < values.size(); ++i) sum += luminances_[i] * double{values[i]};
  return sum;
}

double Sky::density(Place place) const { return brightness(place) / whole_; }

Sky::Found Sky::bright(float u, float v) const {
  const std::uint32_t width = picture_->width;
  const auto row = std::upper_bound(up_to_row_.begin() + 1, up_to_row_.end() - 1, u);
  const auto y = static_cast<std::uint32_t>(row - up_to_row_.begin()) - 1;
  const float rest = (u - up_to_row_[y]) / std::max(up_to_row_[y + 1] - up_to_row_[y], 1e-30F);
  const auto first = up_to_pixel_.begin() + std::size_t{y} * width;
  const auto pixel = std::upper_bound(first, first + width - 1, v);
  const auto x = static_cast<std::uint32_t>(pixel - first);
  const float before = x == 0 ? 0 : *(pixel - 1);
  const float across = (v - before) / std::max(*pixel - before, 1e-30F);

  // Even over the pixel's part of the sphere.
  const float cosine = edges_[y] + std::clamp(rest, 0.0F, 1.0F) * (edges_[y + 1] - edges_[y]);
  const float sine = std::sqrt(std::max(0.0F, 1 - cosine * cosine));
  const float longitude =
      two_pi *
      ((static_cast<float>(x) + std::clamp(across, 0.0F, 1.0F)) / static_cast<float>(width) - 0.5F);
  return {turned({sine * std::sin(longitude), cosine, -sine * std::cos(longitude)}, -sine_),
          {x, y}};
}

void Sky::put_sample(const Direction& normal, std::uint32_t index, std::uint32_t seed,
                     Sample8& sample, unsigned lane) const {
  // Take turns; who begins is up to the pixel, so that an odd number favours neither.
  const bool by_picture = ((index ^ hashed(seed, 5)) & 1) != 0;
  Point8 point;
  Pattern{index >> 1, hashed(seed, by_picture ? 3 : 4)}.put(point, lane);
  const float u = point.u[lane], v = point.v[lane];

  // Where the sky is alike everywhere, the half that the normal points to is the picture.
  Direction direction;
  const float* radiance = &alike;
  double density_there = 0.5 / std::numbers::pi;
  if (!by_picture)
    direction = about(normal, std::sqrt(std::max(u, 1e-12F)), v);
  else if (!picture_)
    direction = about(normal, u, v);
  if (picture_) {
    Place place;
    if (by_picture) {
      const Found found = bright(u, v);
      direction = found.direction;
      place = found.place;
    } else {
      place = place_of(direction);
    }
    density_there = density(place);
    radiance = picture_->at(place.x, place.y).data();
  }
  const double cosine =
      double{normal[0] * direction[0] + normal[1] * direction[1] + normal[2] * direction[2]};
  const double both = 0.5 * density_there + 0.5 * std::max(0.0, cosine) / std::numbers::pi;
  sample.direction.x[lane] = direction[0];
  sample.direction.y[lane] = direction[1];
  sample.direction.z[lane] = direction[2];
  sample.weight[lane] = both > 0 ? static_cast<float>(1 / (std::numbers::pi * both)) : 0;
  sample.radiance[lane] = radiance;
}

}  // namespace metamer::cpu::soft
