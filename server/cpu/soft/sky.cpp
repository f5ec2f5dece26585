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
      picture_(scene.environment->picture),
      tables_(scene.environment->tables) {}

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

const float* Sky::values(const Eigen::Vector3f& direction) const {
  if (!picture_) return &alike;
  const Place place = place_of({direction.x(), direction.y(), direction.z()});
  return picture_->at(place.x, place.y).data();
}

double Sky::density(Place place) const {
  return tables_->brightness(picture_->at(place.x, place.y)) / tables_->whole;
}

Sky::Found Sky::bright(float u, float v) const {
  const std::uint32_t width = picture_->width;
  const std::vector<float>&rows = tables_->up_to_row, &edges = tables_->edges;
  const auto row = std::upper_bound(rows.begin() + 1, rows.end() - 1, u);
  const auto y = static_cast<std::uint32_t>(row - rows.begin()) - 1;
  const float rest = (u - rows[y]) / std::max(rows[y + 1] - rows[y], 1e-30F);
  const auto first =
      tables_->up_to_pixel.begin() + static_cast<std::ptrdiff_t>(std::size_t{y} * width);
  const auto pixel = std::upper_bound(first, first + width - 1, v);
  const auto x = static_cast<std::uint32_t>(pixel - first);
  const float before = x == 0 ? 0 : *(pixel - 1);
  const float across = (v - before) / std::max(*pixel - before, 1e-30F);

  // Even over the pixel's part of the sphere.
  const float cosine = edges[y] + std::clamp(rest, 0.0F, 1.0F) * (edges[y + 1] - edges[y]);
  const float sine = std::sqrt(std::max(0.0F, 1 - cosine * cosine));
  const float longitude =
      two_pi *
      ((static_cast<float>(x) + std::clamp(across, 0.0F, 1.0F)) / static_cast<float>(width) - 0.5F);
  return {turned({sine * std::sin(longitude), cosine, -sine * std::cos(longitude)}, -sine_),
          {x, y}};
}

void Sky::put_sample(const Eigen::Vector3f& white, std::uint32_t index, std::uint32_t seed,
                     Samples& sample, unsigned lane) const {
  // Take turns; who begins is up to the pixel, so that an odd number favours neither.
  const bool by_picture = ((index ^ hashed(seed, 5)) & 1) != 0;
  Points point;
  Pattern{index >> 1, hashed(seed, by_picture ? 3 : 4)}.put(point, lane);
  const float u = point.u[lane], v = point.v[lane];

  // Where the sky is alike everywhere, the half that the normal points to is the picture.
  const Direction normal{white.x(), white.y(), white.z()};
  Direction direction;
  const float* values = &alike;
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
    values = picture_->at(place.x, place.y).data();
  }
  const double cosine =
      double{normal[0] * direction[0] + normal[1] * direction[1] + normal[2] * direction[2]};
  const double both = 0.5 * density_there + 0.5 * std::max(0.0, cosine) / std::numbers::pi;
  sample.direction.x[lane] = direction[0];
  sample.direction.y[lane] = direction[1];
  sample.direction.z[lane] = direction[2];
  sample.weight[lane] = both > 0 ? static_cast<float>(1 / (std::numbers::pi * both)) : 0;
  sample.values[lane] = values;
}

}  // namespace metamer::cpu::soft
