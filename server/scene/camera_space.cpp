#include "server/scene/camera_space.h"

#include <algorithm>
#include <cmath>

#include "server/scene/placement.h"

namespace metamer {
namespace {

using Kind = lights::Parameter::Kind;

/// Calls it with the kind and the place of each parameter among a light's values.
void for_each_parameter(const RenderLight& light, auto&& call) {
  using Source = RenderLight::Source;
  if (light.source == Source::environment || light.source == Source::object) return;
  std::size_t at = 1;
  for (const lights::Parameter& one : lights::entry(light.light).parameters) {
    call(one.kind, at);
    at += lights::value_count(one.kind);
  }
}

/// How far from its position a light with a surface comes.
double extent(const RenderLight& light) {
  double sum = 0;
  for_each_parameter(light, [&](Kind kind, std::size_t at) {
    if (kind == Kind::length) sum += light.parameters[at];
    if (kind == Kind::vector)
      sum +=
          Eigen::Vector3d(light.parameters[at], light.parameters[at + 1], light.parameters[at + 2])
              .norm();
  });
  return sum;
}

Eigen::Vector3d position(const RenderLight& light, std::size_t at) {
  return {light.parameters[at], light.parameters[at + 1], light.parameters[at + 2]};
}

/// The distance from the eye to the farthest corner of anything.
double reach(const RenderScene& scene) {
  std::vector<Eigen::AlignedBox3d> boxes(scene.meshes.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i] = box_of(scene.meshes[i].positions);
  const Eigen::AlignedBox3d unit(Eigen::Vector3d::Constant(-1), Eigen::Vector3d::Constant(1));

  double farthest = 0;
  for (const RenderObject& object : scene.objects) {
    if (object.shape == RenderObject::Shape::plane) {
      farthest = std::max(farthest, (object.to_world.translation() - scene.camera.eye).norm());
      continue;
    }
    const bool sphere = object.shape == RenderObject::Shape::sphere;
    const Eigen::AlignedBox3d box =
        (sphere ? unit : boxes[object.mesh]).transformed(object.to_world);
    const Eigen::Vector3d far = (box.min() - scene.camera.eye)
                                    .cwiseAbs()
                                    .cwiseMax((box.max() - scene.camera.eye).cwiseAbs());
    farthest = std::max(farthest, far.norm());
  }
  for (const RenderLight& light : scene.lights)
    for_each_parameter(light, [&](Kind kind, std::size_t at) {
      if (kind == Kind::position)
        farthest =
            std::max(farthest, (position(light, at) - scene.camera.eye).norm() + extent(light));
    });
  return farthest;
}

}  // namespace

CameraSpace CameraSpace::of(const RenderScene& scene) {
  constexpr double largest = 1023;  // exponent of an f64: what is smaller than 1/2^1023 stays small
  const double size = reach(scene);
  return {scene.camera.eye,
          size > 0 ? std::exp2(std::min(largest, -std::floor(std::log2(size)))) : 1};
}

void CameraSpace::place(RenderScene& scene) const {
  const Eigen::Affine3d map = Eigen::Scaling(scale) * Eigen::Translation3d(-origin);
  for (RenderObject& object : scene.objects) object.to_world = map * object.to_world;
  for (RenderLight& light : scene.lights) place(light);
  for (RenderMedium& medium : scene.media) place(medium);
  for (RenderMap& map : scene.maps) place(map);
  place(scene.camera);
}

void CameraSpace::place(RenderLight& light) const {
  light.reference_distance *= scale;
  for_each_parameter(light, [&](Kind kind, std::size_t at) {
    if (kind == Kind::length) light.parameters[at] *= scale;
    if (kind != Kind::position && kind != Kind::vector) return;
    const Eigen::Vector3d from = kind == Kind::position ? origin : Eigen::Vector3d::Zero();
    const Eigen::Vector3d placed = scale * (position(light, at) - from);
    std::copy(placed.begin(), placed.end(), &light.parameters[at]);
  });
}

RenderScene to_camera_space(RenderScene scene) {
  CameraSpace::of(scene).place(scene);
  return scene;
}

}  // namespace metamer
