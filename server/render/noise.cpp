#include "server/render/noise.h"

#include <cmath>

namespace metamer {
namespace {

/// Beside the picture's own.
constexpr std::uint32_t others = 4;

/// X Y Z of the run's pixels, fewer once it was stopped.
std::vector<Eigen::Array3d> colors_of(PixelRun run, const PilotScene& pilot, const v1::Plan& plan,
                                      const Method& method, Method::Scratch& scratch) {
  std::vector<Eigen::Array3d> colors;
  const float scale = 1 / static_cast<float>(plan.spp());
  for (const Gather& gather : pilot.probe.trace(plan, run, pilot.stopped, pilot.work).gathers) {
    const std::array<float, 3> xyz = method.resolve(gather, scale, scratch);
    colors.push_back({xyz[0], xyz[1], xyz[2]});
  }
  return colors;
}

Lab lab_of(const Eigen::Array3d& xyz, const Xyz& white) {
  return to_lab({xyz[0], xyz[1], xyz[2]}, white);
}

}  // namespace

std::optional<v1::ColorError> sampling_noise(const PilotScene& pilot, const v1::Plan& plan,
                                             const Method& method, const Xyz& white) {
  const bool has_lens = pilot.scene.camera.aperture_radius > 0;
  if (plan.light_samples() == 0 && plan.bounces() == 0 && !has_lens) return {};
  const auto scratch = method.make_scratch();
  PixelRun run{.first = 0, .count = pilot_count(plan), .random = true};
  std::vector<Eigen::Array3d> first = colors_of(run, pilot, plan, method, *scratch), sum = first;
  for (std::uint32_t k = 0; k < others && !pilot.stopped; ++k) {
    ++run.seed;
    const std::vector<Eigen::Array3d> more = colors_of(run, pilot, plan, method, *scratch);
    if (more.size() < sum.size()) return {};  // stopped
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += more[i];
  }
  // Of n independent values, one is off from their mean by 1 − 1/n of its variance.
  const double of_mean = std::sqrt((others + 1.0) / others);
  std::vector<double> errors;
  for (std::size_t i = 0; i < sum.size(); ++i)
    errors.push_back(of_mean *
                     delta_e_00(lab_of(first[i], white), lab_of(sum[i] / (others + 1.0), white)));
  v1::ColorError noise = summarize(errors);
  noise.set_share(bounded_share(run.count));
  return noise;
}

}  // namespace metamer
