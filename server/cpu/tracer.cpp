#include "server/cpu/tracer.h"

#include <algorithm>
#include <limits>

namespace metamer::cpu {
namespace {

/// Pixels that share a packet, by the samples of each: at most eight samples together.
std::pair<std::uint32_t, std::uint32_t> block_size(unsigned spp) {
  if (spp == 1) return {4, 2};
  if (spp == 2) return {2, 2};
  if (spp <= 4) return {2, 1};
  return {1, 1};
}

Vec8 broadcast(const Eigen::Vector3d& v) {
  return {metamer::broadcast(static_cast<float>(v.x())),
          metamer::broadcast(static_cast<float>(v.y())),
          metamer::broadcast(static_cast<float>(v.z()))};
}

/// Shadow rays end a little before the light, so that a surface in which it lies does not hide it.
constexpr float short_of_light = 0.9999f;
constexpr float largest = std::numeric_limits<float>::max();

/// A cosine as models want it: 0 behind the surface, and not above 1 by rounding.
Float8 cosine(Float8 value) { return min(max(value, Float8{}), metamer::broadcast(1)); }

}  // namespace

/// Where the lanes of a packet are gathered.
struct Tracer::Places {
  std::array<std::uint32_t, 8> surface{};  ///< Of the pixel's gather.
  bool together = true;                    ///< All active lanes in the same place.
  unsigned first = 0;                      ///< An active lane.
};

/// Eight rays on their way, and where their light goes.
struct Tracer::Packet {
  Vec8 origin{}, direction{};  ///< Directions are unit.
  Int8 active{};
  Float8 throughput = metamer::broadcast(1);  ///< Product of the mirrors' weights.
  std::array<std::uint32_t, 8> pixel{};       ///< Index into Workspace::gathers.
  std::array<std::uint32_t, 8> path{};        ///< Of that pixel's gather.
  Vec8 hit{};                                 ///< Where the ray hit.
  Vec8 point{};                               ///< The same, lifted off the surface.
};

Tracer::Tracer(const RenderScene& scene, const EmbreeScene& geometry, const Method& method,
               const v1::Plan& plan)
    : scene_(scene), geometry_(geometry), method_(method), depth_(plan.depth()), spp_(plan.spp()) {
  std::tie(block_width_, block_height_) = block_size(spp_);
  prepare_samples();
  for (const RenderLight& light : scene.lights)
    lights_.push_back({light.directional, broadcast(light.place),
                       static_cast<float>(light.reference_distance * light.reference_distance)});

  // Scale the camera's axes to pixels; pixels are square.
  const RenderCamera& camera = scene.camera;
  const double pixel = 2 * camera.tan_half_fov / plan.height();
  eye_ = broadcast(camera.eye);
  across_ = broadcast(Eigen::Vector3d(camera.right * pixel));
  down_ = broadcast(Eigen::Vector3d(-camera.up * pixel));
  corner_ = broadcast(Eigen::Vector3d(camera.forward - camera.right * (pixel * plan.width() / 2) +
                                      camera.up * (pixel * plan.height() / 2)));
}

void Tracer::prepare_samples() {
  const std::vector<SamplePoint> pattern = sample_pattern(spp_);
  const unsigned count = spp_ * block_width_ * block_height_;
  samples_.resize((count + lane_count - 1) / lane_count);
  for (unsigned i = 0; i < count; ++i) {
    const unsigned pixel = i / spp_, lane = i % lane_count;
    Samples& samples = samples_[i / lane_count];
    samples.active[lane] = -1;
    samples.pixel[lane] = pixel;
    samples.x[lane] = static_cast<float>(pixel % block_width_) + pattern[i % spp_].x;
    samples.y[lane] = static_cast<float>(pixel / block_width_) + pattern[i % spp_].y;
  }
}

Tracer::Workspace Tracer::make_workspace() const {
  Workspace workspace;
  workspace.gathers.assign(block_width_ * block_height_, Gather(lights_.size()));
  return workspace;
}

void Tracer::render(const Rect& tile, const Film& film, Workspace& workspace,
                    const std::atomic<bool>& cancelled, std::atomic<std::uint64_t>& work) const {
  for (std::uint32_t y = tile.y; y < tile.y + tile.height; y += block_height_) {
    if (cancelled.load(std::memory_order_relaxed)) return;
    for (std::uint32_t x = tile.x; x < tile.x + tile.width; x += block_width_)
      render_block(x, y, film, workspace);
    work.fetch_add(tile.width * block_height_, std::memory_order_relaxed);
  }
}

void Tracer::render_block(std::uint32_t x, std::uint32_t y, const Film& film,
                          Workspace& workspace) const {
  for (Gather& gather : workspace.gathers) gather.clear();
  for (const Samples& samples : samples_) {
    const Float8 film_x = metamer::broadcast(static_cast<float>(x)) + samples.x;
    const Float8 film_y = metamer::broadcast(static_cast<float>(y)) + samples.y;
    Packet packet;
    packet.active = samples.active & (film_x < static_cast<float>(film.width)) &
                    (film_y < static_cast<float>(film.height));
    packet.pixel = samples.pixel;
    packet.origin = eye_;
    packet.direction = normalize(corner_ + across_ * film_x + down_ * film_y);
    trace(packet, workspace);
  }

  // Turn what each pixel gathered into its colour.
  for (unsigned pixel = 0; pixel < workspace.gathers.size(); ++pixel) {
    const std::uint32_t px = x + pixel % block_width_, py = y + pixel / block_width_;
    if (px < film.width && py < film.height)
      film.set(px, py,
               method_.resolve(workspace.gathers[pixel], 1 / static_cast<float>(spp_),
                               workspace.scratch));
  }
}

void Tracer::trace(Packet& packet, Workspace& workspace) const {
  for (unsigned mirrors = 0;; ++mirrors) {
    workspace.rays += static_cast<unsigned>(count(packet.active));
    const Hits hits = geometry_.intersect(packet.origin, packet.direction, packet.active);
    packet.active = hits.hit;
    if (!any(packet.active)) return;

    // Lift the point off its surface, by what f32 may have got wrong and a little more.
    packet.hit = packet.origin + packet.direction * hits.distance;
    const Vec8& hit = packet.hit;
    const Float8 size = max(max(abs(hit.x), abs(hit.y)), max(abs(hit.z), hits.distance));
    packet.point = hit + hits.geometric_normal * (size * 1e-5f);
    shade(packet, hits, workspace);
    if (mirrors == depth_) return;
    reflect(packet, hits, workspace);
    if (!any(packet.active)) return;
  }
}

void Tracer::shade(const Packet& packet, const Hits& hits, Workspace& workspace) const {
  const Places places = find_places(packet, hits, workspace);
  for (std::size_t l = 0; l < lights_.size(); ++l) {
    // Look towards the light from the surface itself: the lift would show in a near light.
    const Light& light = lights_[l];
    Vec8 to_light = light.place;
    Float8 length = metamer::broadcast(std::numeric_limits<float>::infinity());
    Float8 weight = packet.throughput;
    if (!light.directional) {
      const Vec8 way = light.place - packet.hit;
      const Float8 squared = dot(way, way);
      const Float8 distance = sqrt(squared);
      to_light = way * (1.0f / distance);
      length = distance * short_of_light;
      if (light.reference_squared > 0) weight *= light.reference_squared / squared;
    }
    const Float8 n_dot_l = dot(hits.normal, to_light);
    // Closer to a light than f32 can say, its weight is infinite: such a point has no colour.
    const Int8 facing = packet.active & (n_dot_l > 0.0f) & (weight <= largest);
    if (!any(facing)) continue;
    workspace.rays += static_cast<unsigned>(count(facing));
    const Int8 lit = geometry_.visible(packet.point, to_light, length, facing);
    if (!any(lit)) continue;

    // Evaluate the models and gather their lobes.
    const Float8 n_dot_h = dot(hits.normal, normalize(to_light - packet.direction));
    models::LobeLanes lobes = evaluate(hits, lit, {cosine(n_dot_l), cosine(n_dot_h)});
    const Float8 lit_weight = select(lit, weight, Float8{});
    lobes.diffuse *= lit_weight;
    lobes.specular *= lit_weight;
    lobes.white *= lit_weight;
    gather(packet, places, l, lobes, lit, workspace);
  }
}

/// Finds where each lane's light is gathered.
Tracer::Places Tracer::find_places(const Packet& packet, const Hits& hits,
                                   Workspace& workspace) const {
  Places places;
  int last = -1;
  for (unsigned i = 0; i < lane_count; ++i) {
    if (!packet.active[i]) continue;
    const auto material = static_cast<std::uint32_t>(hits.material[i]);
    const bool as_last = last >= 0 && packet.pixel[i] == packet.pixel[last] &&
                         packet.path[i] == packet.path[last] &&
                         hits.material[i] == hits.material[last];
    places.surface[i] = as_last
                            ? places.surface[last]
                            : workspace.gathers[packet.pixel[i]].surface(packet.path[i], material);
    places.together &= last < 0 || as_last;
    last = static_cast<int>(i);
  }
  places.first = static_cast<unsigned>(last);
  return places;
}

/// Evaluates each material that the packet has lit, once for all of its lanes.
models::LobeLanes Tracer::evaluate(const Hits& hits, Int8 lit,
                                   const models::AngleLanes& angles) const {
  models::LobeLanes lobes{};
  for (unsigned first = 0; first < lane_count; ++first) {
    if (!lit[first]) continue;
    const Int8 same = hits.material == hits.material[first];
    const RenderMaterial& material =
        scene_.materials[static_cast<std::size_t>(hits.material[first])];
    const models::LobeLanes own = models::evaluate(material.model, material.parameters, angles);
    lobes.diffuse = select(same, own.diffuse, lobes.diffuse);
    lobes.specular = select(same, own.specular, lobes.specular);
    lobes.white = select(same, own.white, lobes.white);
    lit &= ~same;
  }
  return lobes;
}

/// Adds weighted lobes where they are gathered; lanes that are not lit hold zeros.
void Tracer::gather(const Packet& packet, const Places& places, std::size_t light,
                    const models::LobeLanes& lobes, Int8 lit, Workspace& workspace) const {
  if (places.together) {
    LobeWeights& to =
        workspace.gathers[packet.pixel[places.first]].weights(places.surface[places.first], light);
    to.diffuse += sum(lobes.diffuse);
    to.specular += sum(lobes.specular);
    to.white += sum(lobes.white);
    return;
  }
  for (unsigned i = 0; i < lane_count; ++i) {
    if (!lit[i]) continue;
    LobeWeights& to = workspace.gathers[packet.pixel[i]].weights(places.surface[i], light);
    to.diffuse += lobes.diffuse[i];
    to.specular += lobes.specular[i];
    to.white += lobes.white[i];
  }
}

void Tracer::reflect(Packet& packet, const Hits& hits, Workspace& workspace) const {
  // Keep the lanes that met a mirror.
  for (unsigned i = 0; i < lane_count; ++i) {
    if (!packet.active[i]) continue;
    const auto material = static_cast<std::uint32_t>(hits.material[i]);
    const float mirror = scene_.materials[material].mirror;
    if (mirror > 0) {
      packet.throughput[i] *= mirror;
      packet.path[i] = workspace.gathers[packet.pixel[i]].path(packet.path[i], material);
    } else {
      packet.active[i] = 0;
    }
  }

  // Reflect about the shading normal, or the surface's own where that would lead below it.
  const auto mirrored = [&](const Vec8& normal) {
    return packet.direction - normal * (2.0f * dot(packet.direction, normal));
  };
  const Vec8 smooth = mirrored(hits.normal);
  const Int8 above = dot(smooth, hits.geometric_normal) > 0.0f;
  packet.direction = normalize(select(above, smooth, mirrored(hits.geometric_normal)));
  packet.origin = packet.point;
}

}  // namespace metamer::cpu
