#include "common/scene/absorption_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace metamer {
namespace {

constexpr double step = 0.0125;                       ///< Its square by 8 is 1.95e-5.
constexpr double opaque = 1e-30;                      ///< Of a transmittance.
constexpr double turn = 2;                            ///< From one half of the nodes to the other.
constexpr double ratio = step * std::numbers::e / 2;  ///< Of s, between two nodes above it.

/// A node's number, continuous.
double number_of(double s) {
  if (s <= turn) return -std::expm1(-s / 2) * (2 / step);
  return -std::expm1(-turn / 2) * (2 / step) + std::log(s / turn) / ratio;
}

const std::array<double, absorption_nodes>& nodes() {
  static const auto all = [] {
    std::array<double, absorption_nodes> made{};
    const double at_turn = number_of(turn);
    for (std::uint32_t i = 0; i < absorption_nodes; ++i)
      made[i] =
          i <= at_turn ? -2 * std::log1p(i * (-step / 2)) : turn * std::exp((i - at_turn) * ratio);
    return made;
  }();
  return all;
}

double depth_of(double transmittance) { return -std::log(std::clamp(transmittance, opaque, 1.0)); }

}  // namespace

double absorption_node(std::uint32_t i) { return nodes()[i]; }

AbsorptionPlace absorption_place(float length) {
  const double s = std::clamp(double{length}, 0.0, nodes().back());
  const auto below = std::min(static_cast<std::uint32_t>(number_of(s)), absorption_nodes - 2);
  const double from = nodes()[below], to = nodes()[below + 1];
  return {below, static_cast<float>((s - from) / (to - from))};
}

double optical_depth(const Spectrum& transmittance) {
  return depth_of(*std::min_element(transmittance.values.begin(), transmittance.values.end()));
}

std::vector<double> relative_depth(const Spectrum& transmittance, const std::vector<double>& nm) {
  const double strongest = optical_depth(transmittance);
  std::vector<double> values = resample(transmittance, nm, Outside::hold).values;
  for (double& value : values) value = depth_of(value) / strongest;
  return values;
}

std::vector<double> transmitted(const std::vector<double>& relative_depth, double length) {
  std::vector<double> values;
  values.reserve(relative_depth.size());
  for (const double depth : relative_depth) values.push_back(std::exp(-depth * length));
  return values;
}

}  // namespace metamer
