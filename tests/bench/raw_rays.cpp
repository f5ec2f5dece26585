#include "tests/bench/raw_rays.h"

#include <limits>

#include "common/lights/reference.h"
#include "server/film/sample_pattern.h"

namespace metamer::bench {
namespace {

RTCIntersectContext coherent_context() {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  return context;
}

Eigen::Vector3f vector_of(const Vectors& v, int lane) { return {v.x[lane], v.y[lane], v.z[lane]}; }

}  // namespace

template <int lanes>
template <class To>
void RawRays<lanes>::set(To& packet, int lane, const Eigen::Vector3f& origin,
                         const Eigen::Vector3f& direction, float length) {
  packet.valid[lane] = -1;
  packet.ray.org_x[lane] = origin.x();
  packet.ray.org_y[lane] = origin.y();
  packet.ray.org_z[lane] = origin.z();
  packet.ray.dir_x[lane] = direction.x();
  packet.ray.dir_y[lane] = direction.y();
  packet.ray.dir_z[lane] = direction.z();
  packet.ray.tfar[lane] = length;
  packet.ray.mask[lane] = ~0u;
  ++count_;
}

template <int lanes>
RawRays<lanes>::RawRays(const RenderScene& scene, const cpu::EmbreeScene& geometry,
                        const v1::Plan& plan) {
  constexpr std::uint32_t pixels = lanes / group_size;  // side by side in a packet
  const auto pattern = sample_pattern(plan.spp());
  const RenderCamera& camera = scene.camera;
  const double pixel = 2 * camera.tan_half_fov / plan.height();
  for (std::uint32_t tile_y = 0; tile_y < plan.height(); tile_y += plan.tile_size())
    for (std::uint32_t tile_x = 0; tile_x < plan.width(); tile_x += plan.tile_size())
      for (std::uint32_t i = 0; i < plan.tile_size() * plan.tile_size(); i += pixels)
        for (std::uint32_t first = 0; first < plan.spp(); first += group_size) {
          Packet packet;
          packet.shadows = shadows_.size();
          for (std::uint32_t lane = 0; lane < lanes; ++lane) {
            const auto& sample = pattern[first + lane % group_size];
            const std::uint32_t at = i + lane / group_size;
            const double x = tile_x + at % plan.tile_size() + double{sample.x};
            const double y = tile_y + at / plan.tile_size() + double{sample.y};
            const Eigen::Vector3d way = camera.forward +
                                        camera.right * (pixel * (x - plan.width() / 2.0)) -
                                        camera.up * (pixel * (y - plan.height() / 2.0));
            set(packet, static_cast<int>(lane), camera.eye.cast<float>(),
                way.normalized().cast<float>(), std::numeric_limits<float>::infinity());
          }
          packets_.push_back(packet);
          add_shadows(scene, geometry, packet);
        }
}

/// A shadow ray for each light that a hit faces.
template <int lanes>
void RawRays<lanes>::add_shadows(const RenderScene& scene, const cpu::EmbreeScene& geometry,
                                 const Packet& camera) {
  const std::size_t lights = scene.lights.size();
  std::vector<Shadows> shadows(lanes / group_size * lights);  // of a light one beside the other
  std::vector<bool> used(shadows.size());
  for (int group = 0; group < lanes; group += group_size) {
    const auto place = [&](const float* x, const float* y, const float* z) {
      return Vectors{load(x + group), load(y + group), load(z + group)};
    };
    const Vectors origin = place(camera.ray.org_x, camera.ray.org_y, camera.ray.org_z),
                  direction = place(camera.ray.dir_x, camera.ray.dir_y, camera.ray.dir_z);
    const cpu::Hits hits = geometry.intersect(origin, direction, Ints{} - 1);
    for (int lane = 0; lane < group_size; ++lane) {
      if (!hits.hit[lane]) continue;
      const Eigen::Vector3f point =
          vector_of(origin, lane) + vector_of(direction, lane) * hits.distance[lane];
      const float size = std::max(point.cwiseAbs().maxCoeff(), hits.distance[lane]);
      const Eigen::Vector3f lifted =
          point + vector_of(hits.geometric_normal, lane) * (size * 1e-5f);
      for (std::size_t l = 0; l < lights; ++l) {
        const RenderLight& light = scene.lights[l];
        const lights::Incident from =
            lights::incident(light.light, light.values(), lifted.cast<double>());
        const Eigen::Vector3f way = from.direction.cast<float>();
        if (!(vector_of(hits.normal, lane).dot(way) > 0)) continue;
        const std::size_t at =
            l * (lanes / group_size) + static_cast<std::size_t>(group / group_size);
        set(shadows[at], lane, lifted, way, static_cast<float>(from.reach));
        used[at] = true;
      }
    }
  }
  for (std::size_t i = 0; i < shadows.size(); ++i)
    if (used[i]) shadows_.push_back(shadows[i]);
}

template <int lanes>
void RawRays<lanes>::replay(RTCScene scene) const {
  RTCIntersectContext context = coherent_context();
  auto shadow = shadows_.begin();
  const auto occlude_until = [&](std::size_t end) {
    for (; shadow != shadows_.begin() + static_cast<std::ptrdiff_t>(end); ++shadow) {
      RTCRay8 ray = shadow->ray;
      rtcOccluded8(shadow->valid, scene, &context, &ray);
    }
  };
  for (const Packet& packet : packets_) {
    occlude_until(packet.shadows);
    typename Embree::RayHits ray;
    ray.ray = packet.ray;
    for (int lane = 0; lane < lanes; ++lane) {
      ray.hit.geomID[lane] = RTC_INVALID_GEOMETRY_ID;
      ray.hit.instID[0][lane] = RTC_INVALID_GEOMETRY_ID;
    }
    Embree::intersect(packet.valid, scene, &context, &ray);
  }
  occlude_until(shadows_.size());
}

template class RawRays<8>;
template class RawRays<16>;

}  // namespace metamer::bench
