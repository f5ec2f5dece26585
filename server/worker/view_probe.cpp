#include "server/worker/view_probe.h"

#include <algorithm>

namespace metamer::worker {
namespace {

void set(v1::Vec3& to, const Eigen::Vector3d& v) {
  to.set_x(v.x());
  to.set_y(v.y());
  to.set_z(v.z());
}

void set(google::protobuf::RepeatedField<double>& to, const std::vector<double>& values) {
  to.Add(values.begin(), values.end());
}

/// Its name, or else its place in the scene, as problems have it.
std::string name_of(const RenderScene& scene, std::uint32_t object) {
  const std::string& name = scene.objects[object].name;
  return name.empty() ? "object[" + std::to_string(object) + "]" : name;
}

}  // namespace

v1::Probed ViewProbe::look(ViewScene& scene, const v1::Plan& plan, const v1::Probe& probe) {
  v1::Probed probed;
  if (probe.x() >= plan.width() || probe.y() >= plan.height()) return probed;
  const std::atomic<bool> never = false;
  if (!probe_) probe_ = scene.renderer().make_probe();
  if (!probe_->prepare(never)) return probed;
  const auto seen = probe_->look(plan, probe.x(), probe.y());
  if (!seen) return probed;

  const RenderScene& in = scene.scene();
  if (!spectra_) spectra_.emplace(in);
  const std::uint32_t material = in.objects[seen->object].material;
  probed.set_object(name_of(in, seen->object));
  probed.set_material(in.materials[material].name);
  set(*probed.mutable_place(), scene.space().to_world(seen->place));
  set(*probed.mutable_normal(), seen->normal);
  set(*probed.mutable_eye(), spectra_->eye(seen->eye));
  set(*probed.mutable_light(), spectra_->light(seen->light));
  set(*probed.mutable_surface(), spectra_->surface(material));
  return probed;
}

Xyz mean_of(const ShownFrame& frame, const v1::Probe& probe) {
  // Of a coarse frame, those pixels that stand for the square's.
  const auto range = [&](std::uint32_t middle, std::uint32_t size) {
    const std::uint32_t side = std::max(1u, probe.side()), before = (side - 1) / 2;
    const std::uint32_t first = middle - std::min(middle, before),
                        last = middle - before + side - 1;
    return std::pair(first / frame.part, std::min(last / frame.part, size - 1));
  };
  const auto [left, right] = range(probe.x(), frame.width);
  const auto [top, bottom] = range(probe.y(), frame.height);
  Xyz mean{};
  for (std::uint32_t y = top; y <= bottom; ++y)
    for (std::uint32_t x = left; x <= right; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        mean[c] += double{frame.scale * frame.sums[(std::size_t{y} * frame.width + x) * 3 + c]};
  for (double& value : mean)
    value /= (static_cast<double>(right - left) + 1) * (static_cast<double>(bottom - top) + 1);
  return mean;
}

}  // namespace metamer::worker
