#include "server/scene/bundles.h"

#include <algorithm>
#include <cmath>

namespace metamer {
namespace {

constexpr double from_nm = 390, to_nm = 710;

std::vector<double> every_nm_seen() {
  std::vector<double> nm;
  for (double at = from_nm; at <= to_nm; ++at) nm.push_back(at);
  return nm;
}

const Spectrum& n_of(const RenderScene& scene, const RenderMedium& medium) {
  return scene.constants[scene.materials[medium.material].constants].n;
}

/// By nm: the largest change of any medium's n up to there.
std::vector<double> changes(const RenderScene& scene, const std::vector<double>& nm) {
  std::vector<double> sums(nm.size());
  std::vector<double> steps(nm.size());
  for (const RenderInterface& one : scene.interfaces)
    for (const std::uint32_t number : {one.rare, one.dense}) {
      if (!scene.media[number].dispersion) continue;
      const std::vector<double> n =
          resample(n_of(scene, scene.media[number]), nm, Outside::hold).values;
      for (std::size_t i = 1; i < nm.size(); ++i)
        steps[i] = std::max(steps[i], std::abs(n[i] - n[i - 1]));
    }
  for (std::size_t i = 1; i < nm.size(); ++i) sums[i] = sums[i - 1] + steps[i];
  return sums;
}

/// Where a rising function of wavelength has grown by each of the equal steps.
std::vector<double> middles(const std::vector<double>& nm, const std::vector<double>& sums,
                            std::size_t count) {
  std::vector<double> found;
  std::size_t i = 0;
  for (std::size_t b = 0; b < count; ++b) {
    const double wanted = sums.back() * static_cast<double>(b) / static_cast<double>(count - 1);
    while (i + 2 < nm.size() && sums[i + 1] < wanted) ++i;
    const double step = sums[i + 1] - sums[i];
    const double at = nm[i] + (step > 0 ? std::clamp((wanted - sums[i]) / step, 0.0, 1.0) : 0);
    if (found.empty() || at > found.back()) found.push_back(at);
  }
  return found;
}

}  // namespace

void choose_windows(RenderScene& scene) {
  scene.windows.clear();
  const std::vector<double> nm = every_nm_seen(), sums = changes(scene, nm);
  if (!(sums.back() > 0)) return;
  const double wanted = std::ceil(sums.back() / (scene.pixel_angle / 2)) + 1;
  const auto count =
      static_cast<std::size_t>(std::clamp(wanted, 2.0, static_cast<double>(max_bundles)));
  if (wanted > static_cast<double>(max_bundles))
    scene.notices.push_back(
        {"settings.height", "dispersion would need " + std::to_string(static_cast<long>(wanted)) +
                                " bundles of wavelengths for pixels that small: " +
                                std::to_string(max_bundles) + " are taken"});
  const std::vector<double> at = middles(nm, sums, count);
  for (std::size_t b = 0; b < at.size(); ++b) {
    Spectrum window;
    const auto add = [&](double x, double value) {
      window.nm.push_back(x);
      window.values.push_back(value);
    };
    if (b > 0) add(at[b - 1], 0);
    add(at[b], 1);
    if (b + 1 < at.size()) add(at[b + 1], 0);
    scene.windows.push_back(std::move(window));
  }
}

double middle_of(const Spectrum& window) {
  const auto top = std::max_element(window.values.begin(), window.values.end());
  return window.nm[static_cast<std::size_t>(top - window.values.begin())];
}

double index_in(const RenderScene& scene, const RenderMedium& medium, const Spectrum& window) {
  if (&medium == scene.media.data()) return 1;
  if (!medium.dispersion) return medium.index;
  return resample(n_of(scene, medium), {middle_of(window)}, Outside::hold).values.front();
}

}  // namespace metamer
