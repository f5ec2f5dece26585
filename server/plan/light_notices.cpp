#include "server/plan/light_notices.h"

#include <algorithm>
#include <optional>

#include "server/scene/placement.h"

namespace metamer {
namespace {

using Eigen::Vector3d;

void say(const std::string& field, const std::string& message, v1::Plan& plan) {
  v1::Notice& notice = *plan.add_notice();
  notice.set_field(field);
  notice.set_message(message);
}

Vector3d vector_at(const RenderLight& light, std::size_t at) {
  return {light.parameters[at], light.parameters[at + 1], light.parameters[at + 2]};
}

/// Where a light with a surface sends none: behind a quad or disk, inside a sphere.
struct Dark {
  Vector3d middle, normal;
  double radius;  ///< Of a sphere; else 0.
  double area;    ///< Or the square of a radius.

  /// But for what lies in the light itself, as far as that can be told.
  bool has(const Vector3d& point) const {
    const Vector3d way = point - middle;
    if (radius > 0) return way.norm() <= radius;
    return normal.dot(way) <= 1e-9 * way.norm();
  }
};

std::optional<Dark> dark_of(const RenderLight& light) {
  if (light.source != RenderLight::Source::surface) return std::nullopt;
  const Vector3d place = vector_at(light, 1);
  switch (light.light) {
    case lights::Light::quad: {
      const Vector3d u = vector_at(light, 4), v = vector_at(light, 7);
      return Dark{place + (u + v) / 2, unit(u).cross(unit(v)).normalized(), 0, u.cross(v).norm()};
    }
    case lights::Light::disk:
      return Dark{place, unit(vector_at(light, 4)), 0, light.parameters[7] * light.parameters[7]};
    case lights::Light::sphere:
      return Dark{place, Vector3d::Zero(), light.parameters[4],
                  light.parameters[4] * light.parameters[4]};
    default:
      return std::nullopt;
  }
}

/// Whether the light sees any of an object's points.
bool reaches(const Dark& dark, const RenderScene& scene, const RenderObject& object) {
  const Eigen::Matrix3d axes = object.to_world.linear();
  const Vector3d origin = object.to_world.translation();
  const Vector3d away = dark.radius > 0 ? Vector3d(origin - dark.middle) : dark.normal;
  switch (object.shape) {
    case RenderObject::Shape::mesh: {
      const Positions& positions = scene.meshes[object.mesh].positions;
      for (std::size_t i = 0; i < positions.size(); ++i)
        if (!dark.has(object.to_world * to_vector(positions[i]))) return true;
      return false;
    }
    case RenderObject::Shape::sphere: {
      // Its farthest point that way.
      const Vector3d own = axes.transpose() * away;
      const Vector3d farthest = own.norm() > 0 ? Vector3d(own.normalized()) : Vector3d::UnitX();
      return !dark.has(object.to_world * farthest);
    }
    case RenderObject::Shape::plane:
      break;
  }
  // It goes on as far as it is drawn.
  constexpr double far_away = 1e6;
  for (const int column : {0, 2})
    for (const double sign : {-far_away, far_away})
      if (!dark.has(origin +
                    sign * (1 + (origin - dark.middle).norm()) * axes.col(column).normalized()))
        return true;
  return !dark.has(origin);
}

std::string dark_text(lights::Light light) {
  switch (light) {
    case lights::Light::quad:
      return "no object is in front of it: it shines to the side of u × v alone, and to the other "
             "with u and v changed";
    case lights::Light::disk:
      return "no object is in front of it: it shines to the side of its normal alone";
    default:
      return "all objects are inside it: it shines outwards alone";
  }
}

/// Says which lights with a surface light nothing, for where they are.
void notice_dark(const RenderScene& scene, v1::Plan& plan) {
  for (const RenderLight& light : scene.lights) {
    const std::optional<Dark> dark = dark_of(light);
    if (!dark) continue;
    if (std::none_of(scene.objects.begin(), scene.objects.end(),
                     [&](const RenderObject& object) { return reaches(*dark, scene, object); }))
      say(light.field, dark_text(light.light), plan);
    // Products with it are no numbers of f32.
    constexpr double least_area = 1e-36;
    if (dark->area < least_area)
      say(light.field,
          "it is smaller than 1e-18 of the scene and sends no light: a light with a position does",
          plan);
    if (dark->radius > 0 && dark->has(scene.camera.eye))
      say(light.field,
          "the eye is inside it: it shines outwards alone, so that what is inside is dark", plan);
  }
}

}  // namespace

void notice_lights(const RenderScene& scene, const std::vector<Need>& needs, v1::Plan& plan) {
  if (plan.light_samples() == 0) return;
  const auto first = std::find_if(needs.begin(), needs.end(), [](const Need& need) {
    return need.feature == Feature::area_lights || need.feature == Feature::environment;
  });
  say(first->field,
      "a pixel looks at " + std::to_string(std::uint64_t{plan.spp()} * plan.light_samples()) +
          " points of it (spp " + std::to_string(plan.spp()) + " × light_samples " +
          std::to_string(plan.light_samples()) + "): noise beside the error of colour",
      plan);
  notice_dark(scene, plan);
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const RenderObject& object = scene.objects[i];
    if (object.shape != RenderObject::Shape::mesh || object.shading == v1::PHONG) continue;
    say("object[" + std::to_string(i) + "]",
        "under lights with a surface and environments its model is evaluated at every sample, as "
        "by PHONG",
        plan);
    break;
  }
}

}  // namespace metamer
