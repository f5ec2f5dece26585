#include "tests/bench/raw_rays.h"

#include <limits>

#include "common/lights/reference.h"
#include "server/film/sample_pattern.h"

namespace metamer::bench {
namespace {

RTCIntersectContext coherent() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

void set(RTCRay8& ray, int lane, const Eigen::Vector3f& origin, const Eigen::Vector3f& direction,
         float length) {
  ray.org_x[lane] = origin.x();
  ray.org_y[lane] = origin.y();
  ray.org_z[lane] = origin.z();
  ray.dir_x[lane] = direction.x();
  ray.dir_y[lane] = direction.y();
  ray.dir_z[lane] = direction.z();
  ray.tfar[lane] = length;
  ray.mask[lane] = ~0u;
}

}  // namespace

RawRays::RawRays(const RenderScene& scene, const cpu::EmbreeScene& geometry, const v1::Plan& plan) {
  const auto pattern = sample_pattern(plan.spp());
  const RenderCamera& camera = scene.camera;
  const double pixel = 2 * camera.tan_half_fov / plan.height();
  const auto lane_vector = [](const Vec8& v, int lane) {
    return Eigen::Vector3f(v.x[lane], v.y[lane], v.z[lane]);
  };

  for (std::uint32_t tile_y = 0; tile_y < plan.height(); tile_y += plan.tile_size())
    for (std::uint32_t tile_x = 0; tile_x < plan.width(); tile_x += plan.tile_size())
      for (std::uint32_t i = 0; i < plan.tile_size() * plan.tile_size(); ++i)
        for (std::uint32_t first = 0; first < plan.spp(); first += 8) {
          // Eight samples of one pixel.
          Packet packet{};
          Vec8 origin{}, direction{};
          for (unsigned lane = 0; lane < 8; ++lane) {
            const auto& sample = pattern[first + lane];
            const double x = tile_x + i % plan.tile_size() + double{sample.x};
            const double y = tile_y + i / plan.tile_size() + double{sample.y};
            const Eigen::Vector3f way =
                (camera.forward + camera.right * (pixel * (x - plan.width() / 2.0)) -
                 camera.up * (pixel * (y - plan.height() / 2.0)))
                    .normalized()
                    .cast<float>();
            const Eigen::Vector3f eye = camera.eye.cast<float>();
            const int l = static_cast<int>(lane);
            set(packet.ray, l, eye, way, std::numeric_limits<float>::infinity());
            packet.valid[lane] = -1;
            origin.x[l] = eye.x(), origin.y[l] = eye.y(), origin.z[l] = eye.z();
            direction.x[l] = way.x(), direction.y[l] = way.y(), direction.z[l] = way.z();
          }
          packets_.push_back(packet);
          count_ += 8;

          // A shadow ray for each light that a hit faces.
          const cpu::Hits hits = geometry.intersect(origin, direction, Int8{} - 1);
          for (const RenderLight& light : scene.lights) {
            Packet shadow{};
            shadow.shadow = true;
            bool any_facing = false;
            for (int lane = 0; lane < 8; ++lane) {
              if (!hits.hit[lane]) continue;
              const Eigen::Vector3f point =
                  lane_vector(origin, lane) + lane_vector(direction, lane) * hits.distance[lane];
              const float size = std::max(point.cwiseAbs().maxCoeff(), hits.distance[lane]);
              const Eigen::Vector3f lifted =
                  point + lane_vector(hits.geometric_normal, lane) * (size * 1e-5f);
              const lights::Incident from =
                  lights::incident(light.light, light.values(), lifted.cast<double>());
              const Eigen::Vector3f way = from.direction.cast<float>();
              if (!(lane_vector(hits.normal, lane).dot(way) > 0)) continue;
              set(shadow.ray, lane, lifted, way, static_cast<float>(from.reach));
              shadow.valid[lane] = -1;
              any_facing = true;
              ++count_;
            }
            if (any_facing) packets_.push_back(shadow);
          }
        }
}

void RawRays::replay(RTCScene scene) const {
  RTCIntersectContext context = coherent();
  for (const Packet& packet : packets_) {
    if (packet.shadow) {
      RTCRay8 ray = packet.ray;
      rtcOccluded8(packet.valid, scene, &context, &ray);
    } else {
      RTCRayHit8 ray;
      ray.ray = packet.ray;
      for (int lane = 0; lane < 8; ++lane) {
        ray.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
        ray.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
      }
      rtcIntersect8(packet.valid, scene, &context, &ray);
    }
  }
}

}  // namespace metamer::bench
