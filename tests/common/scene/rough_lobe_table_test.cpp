#include "common/scene/rough_lobe_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/models/reference.h"
#include "common/scene/rough_mirror_table.h"
#include "common/spectral/cie.h"
#include "common/spectral/observer.h"

namespace metamer {
namespace {

TEST(RoughLobeTable, WindowsAreAPartitionOfUnityAndEachIsItsOwnNodes) {
  for (double nm = 350; nm < 850; nm += 3.7) {
    double sum = 0;
    for (std::uint32_t w = 0; w < lobe_wavelengths; ++w) sum += lobe_window(w, nm);
    EXPECT_NEAR(sum, 1, 1e-12) << nm;
  }
  for (std::uint32_t w = 0; w < lobe_wavelengths; ++w)
    for (std::uint32_t other = 0; other < lobe_wavelengths; ++other)
      EXPECT_NEAR(lobe_window(w, lobe_nm(other)), w == other, 1e-12);
}

/// What an observer sees, of equal power: of a lobe by every nm, and by its eight weights.
struct Seen {
  std::array<double, 3> truth{}, table{};
};

Seen seen(double height, double spread) {
  static const Observer::Functions functions = cie::observer_1931().functions();
  std::array<double, lobe_wavelengths> weights;
  for (std::uint32_t w = 0; w < lobe_wavelengths; ++w)
    weights[w] = models::ripples(height, spread, lobe_nm(w));
  Seen seen;
  for (double nm = 360; nm <= 830; ++nm) {
    double table = 0;
    for (std::uint32_t w = 0; w < lobe_wavelengths; ++w) table += weights[w] * lobe_window(w, nm);
    const double truth = models::ripples(height, spread, nm);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double sees = resample(functions[axis], {nm}, Outside::zero).values[0];
      seen.truth[axis] += sees * truth;
      seen.table[axis] += sees * table;
    }
  }
  return seen;
}

TEST(RoughLobeTable, EightWavelengthsSeeWhatEveryNanometreDoes) {
  // Beside its mirrored direction, as far as there is light: down to 1e-3 of a lobe's peak.
  for (const double roughness : {0.001, 0.02, 0.05, 0.1, 0.18, 0.3, 1.0})
    for (const double ahead : {0.3, 1.0, 2.0}) {
      const double height = std::pow(roughness * ahead, 2), peak = seen(height, 0).truth[1];
      for (const double spread : {0.0, 0.003, 0.01, 0.03, 0.06, 0.2, 1.0}) {
        const Seen one = seen(height, spread);
        const double most = std::max({one.truth[0], one.truth[1], one.truth[2]});
        if (most < 1e-3 * peak) continue;
        for (std::size_t axis = 0; axis < 3; ++axis)
          EXPECT_NEAR(one.table[axis], one.truth[axis], 6e-4 * std::max(most, 0.1 * peak))
              << roughness << " " << ahead << " " << spread;
      }
    }
}

TEST(RoughLobeTable, LinesBetweenCosinesAreFresnelsTerm) {
  const OpticalConstants glass{{{550}, {1.5}}, {}}, gold{{{550}, {0.35}}, {{550}, {2.7}}};
  for (const OpticalConstants* constants : {&glass, &gold}) {
    const RoughLobeTable table(constants, {}, {lobe_nm(3)});
    for (float u = 0; u <= 1; u += 0.0037f) {
      const FresnelPlace place = lobe_place(u);
      const auto node = [&](std::uint32_t below) {
        return table.values(below * lobe_wavelengths + 3)[0];
      };
      const double line = (1 - double{place.fraction}) * node(place.below) +
                          double{place.fraction} * node(place.below + 1);
      const double k = constants->k.nm.empty() ? 0 : constants->k.values[0];
      EXPECT_NEAR(line, models::conductor_fresnel(u, constants->n.values[0], k), 3e-4) << u;
    }
  }
}

TEST(RoughMirrorTable, LinesBetweenDepthsAreTheExponential) {
  for (float depth = 0; depth < 0.4f; depth += 0.00013f) {
    const RoughMirrorPlace place = rough_mirror_place(depth);
    ASSERT_LT(place.below + 1, rough_mirror_nodes);
    const double below = rough_mirror(rough_mirror_node(place.below), {360})[0],
                 above = rough_mirror(rough_mirror_node(place.below + 1), {360})[0];
    const double line = (1 - double{place.fraction}) * below + double{place.fraction} * above;
    EXPECT_NEAR(line, std::exp(-std::pow(4000 * std::numbers::pi * double{depth} / 360, 2)), 1.4e-4)
        << depth;
  }
}

}  // namespace
}  // namespace metamer
