#include "server/cpu/soft/surface_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "server/cpu/soft/around.h"
#include "server/scene/surface_white.h"

namespace metamer::cpu::soft {
namespace {

using Eigen::Vector3d;
constexpr double pi = std::numbers::pi;
constexpr float infinity = std::numeric_limits<float>::infinity();
/// sr. From farther away, points that are even in area are as good, and f32 has their place better;
/// where the rectangle is more than the light, they are better up to where it is close by.
constexpr double least_near = 0.02, least_near_within = 1;

Vector3d vector_at(const RenderLight& light, std::size_t at) {
  return {light.parameters[at], light.parameters[at + 1], light.parameters[at + 2]};
}

}  // namespace

SurfaceLight::SurfaceLight(const RenderLight& light) {
  if (light.reference_distance > 0)
    radiance_ = static_cast<float>(1 / white_before(light, light.reference_distance));
  switch (light.light) {
    case lights::Light::quad:
      shape_ = Shape::quad;
      u_ = vector_at(light, 4), v_ = vector_at(light, 7);
      middle_ = vector_at(light, 1) + u_ / 2 + v_ / 2;
      normal_ = u_.cross(v_).normalized();
      break;
    case lights::Light::disk: {
      shape_ = Shape::disk;
      middle_ = vector_at(light, 1);
      normal_ = vector_at(light, 4).normalized();
      radius_ = light.parameters[7];
      u_ = 2 * radius_ * normal_.unitOrthogonal();
      v_ = normal_.cross(u_);
      break;
    }
    default:
      shape_ = Shape::sphere;
      middle_ = vector_at(light, 1);
      radius_ = light.parameters[4];
  }
  if (shape_ == Shape::sphere) return;
  area_ = shape_ == Shape::disk ? pi * radius_ * radius_ : u_.cross(v_).norm();
  along_u_ = v_.cross(normal_) / u_.dot(v_.cross(normal_));
  along_v_ = normal_.cross(u_) / v_.dot(normal_.cross(u_));

  // The rectangle around it has u's direction.
  x_ = u_.normalized();
  y_ = normal_.cross(x_);
  const double shear = v_.dot(x_);
  length_x_ = u_.norm() + std::abs(shear);
  length_y_ = v_.dot(y_);
  const bool fills = shape_ == Shape::quad && std::abs(shear) < 1e-6 * v_.norm();
  least_near_ = fills ? least_near : least_near_within;
  corner_ = middle_ - u_ / 2 - v_ / 2 + std::min(0.0, shear) * x_;
}

SurfaceLight::SurfaceLight(std::shared_ptr<const PointwiseLight> pointwise)
    : shape_(Shape::pointwise), pointwise_(std::move(pointwise)) {}

SurfaceLight::View SurfaceLight::view(const Vectors& at, Ints active) const {
  View view{};
  view.at = at;
  view.lanes = active;
  if (shape_ == Shape::sphere)
    view_sphere(view);
  else if (shape_ == Shape::pointwise)
    view.own = Ints{} - 1;
  else
    view_quad(view);
  return view;
}

SurfaceLight::View SurfaceLight::view(const Vectors& at, Ints active, Ints own,
                                      Ints primitive) const {
  if (shape_ != Shape::pointwise) return view(at, active & ~own);
  View of_some = view(at, active);
  of_some.own = own ? primitive : of_some.own;
  return of_some;
}

void SurfaceLight::view_sphere(View& view) const {
  const Vectors way = to_lanes(middle_) - view.at;
  const Floats squared = dot(way, way);
  view.distance = sqrt(squared);
  const Floats sine_squared = broadcast(static_cast<float>(radius_ * radius_)) / squared;
  view.lanes &= sine_squared < 1.0f;
  view.axis = way / view.distance;
  // 1 − cos without losing a small one's digits.
  view.cone = sine_squared / (1.0f + sqrt(max(1.0f - sine_squared, Floats{})));
}

/// Ureña et al. (2013), 4.1, in f64: the sum of angles loses what a small rectangle has.
void SurfaceLight::view_quad(View& view) const {
  for (int i = 0; i < lane_count; ++i) {
    if (!view.lanes[i]) continue;
    const Vector3d d = corner_ - Vector3d(view.at.x[i], view.at.y[i], view.at.z[i]);
    const double z = d.dot(normal_);  // below 0 in front of it
    if (!(z < 0)) {
      view.lanes[i] = 0;
      continue;
    }
    const double x0 = d.dot(x_), y0 = d.dot(y_), x1 = x0 + length_x_, y1 = y0 + length_y_;
    // The normals of the pyramid's sides: (0, z, −y0), (−z, 0, x1), (0, −z, y1), (z, 0, −x0).
    const auto part = [z](double edge) { return edge / std::hypot(z, edge); };
    const double b0 = -part(y0), n1 = part(x1), b1 = part(y1), n3 = -part(x0);
    const double g0 = std::acos(-b0 * n1), g1 = std::acos(-n1 * b1), g2 = std::acos(-b1 * n3),
                 g3 = std::acos(-n3 * b0);
    const double angle = g0 + g1 + g2 + g3 - 2 * pi;
    if (!(angle > least_near_)) continue;
    view.near[i] = -1;
    view.x0[i] = static_cast<float>(x0);
    view.x1[i] = static_cast<float>(x1);
    view.y0[i] = static_cast<float>(y0);
    view.y1[i] = static_cast<float>(y1);
    view.z[i] = static_cast<float>(z);
    view.b0[i] = static_cast<float>(b0);
    view.b1[i] = static_cast<float>(b1);
    view.k[i] = static_cast<float>(2 * pi - g2 - g3);
    view.angle[i] = static_cast<float>(angle);
  }
}

/// Their 4.2: even in solid angle, from the view's point.
Vectors SurfaceLight::even_point(const View& view, const Points& point) const {
  const Floats turned = point.u * view.angle + view.k;
  Floats cosine, sine;
  for (int i = 0; i < lane_count; ++i) {
    cosine[i] = std::cos(turned[i]);
    sine[i] = std::sin(turned[i]);
  }
  const Floats f = (cosine * view.b0 - view.b1) / sine;
  const Floats root = 1.0f / sqrt(f * f + view.b0 * view.b0);
  const Floats cu = min(max(select(f > 0.0f, root, -root), broadcast(-1)), broadcast(1));
  Floats x = -(cu * view.z) / sqrt(max(1.0f - cu * cu, broadcast(1e-12F)));
  x = min(max(x, view.x0), view.x1);
  const Floats squared = x * x + view.z * view.z;
  const Floats h0 = view.y0 / sqrt(squared + view.y0 * view.y0);
  const Floats h1 = view.y1 / sqrt(squared + view.y1 * view.y1);
  const Floats h = h0 + point.v * (h1 - h0), left = 1.0f - h * h;
  Floats y = select(left > 1e-6f, h * sqrt(squared) / sqrt(max(left, broadcast(1e-12F))), view.y1);
  y = min(max(y, view.y0), view.y1);
  return to_lanes(x_) * x + to_lanes(y_) * y + to_lanes(normal_) * view.z;
}

/// Even in area, from the middle.
Vectors SurfaceLight::point_of(const Points& point) const {
  if (shape_ == Shape::quad)
    return to_lanes(u_) * (point.u - 0.5f) + to_lanes(v_) * (point.v - 0.5f);
  Floats cosine, sine;
  turn(point.v, cosine, sine);
  const Floats radius = sqrt(point.u) * 0.5f;
  return to_lanes(u_) * (radius * cosine) + to_lanes(v_) * (radius * sine);
}

/// Whether a place of its plane, from its middle, lies on it.
Ints SurfaceLight::covers(const Vectors& offset) const {
  const Floats a = dot(to_lanes(along_u_), offset), b = dot(to_lanes(along_v_), offset);
  if (shape_ == Shape::disk) return a * a + b * b <= 0.25f;
  return (abs(a) <= 0.5f) & (abs(b) <= 0.5f);
}

Samples SurfaceLight::sample(const View& view, const Points& point) const {
  if (shape_ == Shape::sphere) return sample_sphere(view, point);
  if (shape_ == Shape::pointwise) return sample_pointwise(view, point);
  const Vectors to_middle = to_lanes(middle_) - view.at;
  Vectors way = to_middle + point_of(point);
  Ints covered = Ints{} - 1;
  const Ints near = view.near & view.lanes;
  if (any(near)) {
    const Vectors even = even_point(view, point);
    way = select(near, even, way);
    covered = ~near | covers(even - to_middle);
  }
  const Floats squared = dot(way, way), distance = sqrt(squared);
  const Vectors direction = way / distance;
  const Floats cosine = max(-dot(to_lanes(normal_), direction), Floats{});
  const Floats by_area = broadcast(static_cast<float>(area_)) * cosine / squared;
  const Floats weight = select(near, view.angle, by_area) * (radiance_ / static_cast<float>(pi));
  return {direction, distance * reached, select(view.lanes & covered, weight, Floats{})};
}

/// Even in the cone that it fills: P. Shirley, C. Wang and K. Zimmerman, "Monte Carlo Techniques
/// for Direct Lighting Calculations", ACM TOG 15(1), 1996, 3.2.4.
Samples SurfaceLight::sample_sphere(const View& view, const Points& point) const {
  const Floats versine = point.u * view.cone, sine_squared = versine * (2.0f - versine);
  const Floats across = sqrt(sine_squared), along = 1.0f - versine;
  Floats cosine, sine;
  turn(point.v, cosine, sine);
  Vectors s, t;
  basis(view.axis, s, t);
  const Vectors direction = s * (across * cosine) + t * (across * sine) + view.axis * along;
  // To its front: d cos α − √(r² − d² sin² α).
  const Floats left =
      static_cast<float>(radius_ * radius_) - view.distance * view.distance * sine_squared;
  const Floats reach = view.distance * along - sqrt(max(left, Floats{}));
  const Floats weight = 2.0f * radiance_ * view.cone;  // Ω = 2π (1 − cos)
  return {direction, reach * reached, select(view.lanes, weight, Floats{})};
}

Samples SurfaceLight::sample_pointwise(const View& view, const Points& point) const {
  Samples sample{};
  for (int i = 0; i < lane_count; ++i) {
    if (!view.lanes[i]) continue;
    const PointwiseLight::Found found =
        pointwise_->find(Vector3d(view.at.x[i], view.at.y[i], view.at.z[i]), double{point.u[i]},
                         double{point.v[i]}, view.own[i]);
    if (!(found.weight > 0)) continue;
    sample.direction.x[i] = static_cast<float>(found.direction.x());
    sample.direction.y[i] = static_cast<float>(found.direction.y());
    sample.direction.z[i] = static_cast<float>(found.direction.z());
    sample.reach[i] = static_cast<float>(found.distance) * reached;
    sample.weight[i] = static_cast<float>(found.weight) * radiance_;
  }
  return sample;
}

Floats SurfaceLight::meet(const Vectors& origin, const Vectors& direction) const {
  const Vectors way = to_lanes(middle_) - origin;
  if (shape_ == Shape::sphere) {
    const Floats along = dot(way, direction);
    const Vectors off = way - direction * along;
    const Floats left = static_cast<float>(radius_ * radius_) - dot(off, off);
    const Floats distance = along - sqrt(max(left, Floats{}));
    return select((left >= 0.0f) & (distance > 0.0f), distance, broadcast(infinity));
  }
  const Vectors normal = to_lanes(normal_);
  const Floats towards = dot(normal, direction);
  const Floats distance = dot(normal, way) / towards;
  const Ints met = (towards < 0.0f) & (distance > 0.0f) & covers(direction * distance - way);
  return select(met, distance, broadcast(infinity));
}

}  // namespace metamer::cpu::soft
