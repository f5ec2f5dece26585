#include "server/cpu/tracer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "server/cpu/shared_source.h"
#include "server/transport/factor_rows.h"
#include "server/transport/mirror.h"

namespace metamer::cpu {
namespace {

/// The fewest pixels whose samples fill groups of lanes, by the samples of each.
std::pair<std::uint32_t, std::uint32_t> block_size(std::size_t spp) {
  switch (std::gcd(spp, std::size_t{group_size})) {
    case 1:
      return {4, 2};
    case 2:
      return {2, 2};
    case 4:
      return {2, 1};
  }
  return {1, 1};
}

/// Of what rays split in.
std::optional<Media> make_media(const RenderScene& scene, const EmbreeScene& geometry,
                                const Cutouts& cutouts, const Diffusion& diffusion) {
  if (scene.interfaces.empty() && !cutouts.is_needed() && diffusion.bounces == 0) return {};
  return Media(scene, geometry, cutouts);
}

/// The side of a sample's square, seen from a distance of 1.
float footprint_of(const RenderScene& scene, const Tracer::Frame& frame) {
  return static_cast<float>(2 * scene.camera.tan_half_fov /
                            (frame.height * std::sqrt(static_cast<double>(frame.samples.size()))));
}

}  // namespace

Tracer::Frame Tracer::frame_of(const v1::Plan& plan, std::uint32_t width, std::uint32_t height,
                               std::vector<SamplePoint> samples) {
  return {width,
          height,
          plan.depth(),
          std::move(samples),
          static_cast<float>(plan.cutoff()),
          plan.light_samples(),
          {plan.bounces(), plan.bounce_samples()}};
}

Tracer::Tracer(const RenderScene& scene, const EmbreeScene& geometry, const v1::Plan& plan)
    : Tracer(scene, geometry,
             frame_of(plan, plan.width(), plan.height(), sample_pattern(plan.spp()))) {}

Tracer::Tracer(const RenderScene& scene, const EmbreeScene& geometry, const Frame& frame)
    : scene_(scene),
      geometry_(geometry),
      cutouts_(scene, geometry, footprint_of(scene, frame)),
      media_(make_media(scene, geometry, cutouts_, frame.diffusion)),
      shading_(scene, geometry, footprint_of(scene, frame), std::max(1U, frame.light_samples),
               scene.interfaces.empty() && !cutouts_.is_needed() ? nullptr : &*media_),
      depth_(frame.depth),
      width_(frame.width),
      height_(frame.height),
      seed_(frame.seed * 0x9e3779b9U),
      is_sampled_((frame.lens && scene.camera.aperture_radius > 0) || !shading_.soft().empty() ||
                  frame.diffusion.bounces > 0) {
  if (media_)
    tree_.emplace(scene, geometry, *media_, shading_, depth_, frame.cutoff, frame.diffusion);
  std::tie(block_width_, block_height_) = block_size(frame.samples.size());
  prepare_samples(frame.samples);
  if (frame.lens && scene.camera.aperture_radius > 0) lens_.emplace(scene.camera);

  // Scale the camera's axes to pixels; pixels are square.
  const RenderCamera& camera = scene.camera;
  const double pixel = 2 * camera.tan_half_fov / frame.height;
  eye_ = to_lanes(camera.eye);
  across_ = to_lanes(Eigen::Vector3d(camera.right * pixel));
  down_ = to_lanes(Eigen::Vector3d(-camera.up * pixel));
  corner_ = to_lanes(Eigen::Vector3d(camera.forward - camera.right * (pixel * frame.width / 2) +
                                     camera.up * (pixel * frame.height / 2)));
}

void Tracer::prepare_samples(const std::vector<SamplePoint>& pattern) {
  const auto spp = static_cast<unsigned>(pattern.size());
  const unsigned count = spp * block_pixels();
  samples_.resize((count + group_size - 1) / group_size);
  for (unsigned i = 0; i < count; ++i)
    for (unsigned lane = i % group_size; lane < lane_count; lane += group_size) {
      const unsigned pixel = i / spp;
      Samples& samples = samples_[i / group_size];
      samples.active[lane] = -1;
      samples.pixel[lane] = lane / group_size * block_pixels() + pixel;
      samples.number[lane] = pattern[i % spp].number;
      samples.x[lane] = static_cast<float>(pixel % block_width_) + pattern[i % spp].x;
      samples.y[lane] = static_cast<float>(pixel / block_width_) + pattern[i % spp].y;
    }
}

Tracer::Workspace Tracer::make_workspace() const {
  Workspace workspace;
  workspace.gathers.assign(group_count * block_pixels(), gather_for(scene_));
  return workspace;
}

void Tracer::render(const Rect& tile, PixelSink& sink, Workspace& workspace,
                    const std::atomic<bool>& cancelled, std::atomic<std::uint64_t>& work) const {
  for (std::uint32_t y = tile.y; y < tile.y + tile.height; y += block_height_) {
    if (cancelled.load(std::memory_order_relaxed)) return;
    for (std::uint32_t x = tile.x; x < tile.x + tile.width; x += group_count * block_width_) {
      std::array<BlockCorner, group_count> corners;
      std::size_t blocks = 0;
      for (std::uint32_t at = x; at < tile.x + tile.width && blocks < group_count;
           at += block_width_)
        corners[blocks++] = {at, y};
      gather_blocks(std::span(corners).first(blocks), workspace);
      for (std::size_t i = 0; i < blocks * block_pixels(); ++i) {
        const auto pixel = static_cast<std::uint32_t>(i % block_pixels());
        const std::uint32_t px = corners[i / block_pixels()].x + pixel % block_width_,
                            py = y + pixel / block_width_;
        if (px < width_ && py < height_) sink.take(px, py, workspace.gathers[i]);
      }
    }
    work.fetch_add(tile.width * block_height_, std::memory_order_relaxed);
  }
}

void Tracer::gather_blocks(std::span<const BlockCorner> corners, Workspace& workspace) const {
  for (Gather& gather : workspace.gathers) gather.clear();
  Floats left{}, top{};
  Ints used{};
  for (std::size_t group = 0; group < corners.size(); ++group) {
    const Ints lanes = lanes_of(static_cast<unsigned>(group));
    left = select(lanes, metamer::broadcast(static_cast<float>(corners[group].x)), left);
    top = select(lanes, metamer::broadcast(static_cast<float>(corners[group].y)), top);
    used |= lanes;
  }
  for (const Samples& samples : samples_) {
    const Floats film_x = left + samples.x, film_y = top + samples.y;
    Packet packet;
    packet.active = used & samples.active & (film_x < static_cast<float>(width_)) &
                    (film_y < static_cast<float>(height_));
    packet.pixel = samples.pixel;
    if (is_sampled_) {
      packet.sample = samples.number;
      for (unsigned i = 0; i < lane_count; ++i) {
        if (!used[i]) continue;
        const auto [x, y] = corners[i / group_size];
        const std::uint32_t pixel = samples.pixel[i] % block_pixels();
        packet.seed[i] = soft::hashed(x + pixel % block_width_, y + pixel / block_width_ + seed_);
      }
    }
    packet.origin = eye_;
    const Vectors way = corner_ + across_ * film_x + down_ * film_y;
    packet.direction = shared::unit(way);
    if (lens_) lens_->put_rays(way, packet);
    if (tree_)
      tree_->trace(packet, workspace);
    else
      trace(packet, workspace);
  }
}

void Tracer::trace(Packet& packet, Workspace& workspace) const {
  for (unsigned mirrors = 0;; ++mirrors) {
    workspace.add_rays(packet.kind, packet.active);
    Hits hits = geometry_.intersect(packet.origin, packet.direction, packet.active);
    if (const auto& soft = shading_.soft(); !soft.empty())
      soft.add(packet, soft.find(packet, hits), workspace);
    packet.active = hits.hit;
    if (!any(packet.active)) return;
    shading_.soft().add_objects(packet, hits, packet.active, workspace);

    packet.hit = packet.origin + packet.direction * hits.distance;
    packet.point = packet.hit + hits.geometric_normal * shared::lift_off(packet.hit, hits.distance);
    packet.travelled += hits.distance;
    shading_.turn_normals(packet, hits);
    shading_.shade(packet, hits, workspace);
    if (mirrors == depth_) return;
    reflect(packet, hits, workspace);
    if (!any(packet.active)) return;
  }
}

void Tracer::reflect(Packet& packet, const Hits& hits, Workspace& workspace) const {
  // Keep the lanes that met a mirror.
  const Floats incidence = shared::cosine(-dot(hits.normal, packet.direction));
  for (unsigned i = 0; i < lane_count; ++i) {
    if (!packet.active[i]) continue;
    const auto material = static_cast<std::uint32_t>(hits.material[i]);
    const RenderMaterial& from = scene_.materials[material];
    if (from.mirror > 0) {
      float weight = packet.throughput[i];
      packet.chain[i] = over_mirror(workspace.gathers[packet.pixel[i]], packet.chain[i], from,
                                    material, incidence[i], weight);
      packet.throughput[i] = weight;
    } else {
      packet.active[i] = 0;
    }
  }

  // Reflect about the shading normal, or the surface's own where that would lead below it.
  const auto mirrored = [&](const Vectors& normal) {
    return packet.direction - normal * (2.0f * dot(packet.direction, normal));
  };
  const Vectors smooth = mirrored(hits.normal);
  const Ints above = dot(smooth, hits.geometric_normal) > 0.0f;
  packet.direction = shared::unit(select(above, smooth, mirrored(hits.geometric_normal)));
  packet.origin = packet.point;
  packet.kind = RayKind::mirror;
  packet.from_eye = false;
}

}  // namespace metamer::cpu
