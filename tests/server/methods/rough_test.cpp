// What a rough metal sends out, by each method, against a sum over every nm of the model as it
// stands.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/color/lab.h"
#include "common/models/reference.h"
#include "server/transport/mirror.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

struct RoughPatch {
  double roughness, length;
  double light_degrees;  ///< From the normal; the eye is on the other side, 30° from it.
};

constexpr RoughPatch rough_patches[] = {
    {0.03, 3, 34}, {0.08, 3, 38}, {0.18, 3, 30}, {0.3, 2, 45}, {1, 5, 60}};

std::string rough_scene(const RoughPatch& patch, const std::string& settings) {
  const double light = patch.light_degrees * std::numbers::pi / 180;
  return "camera { eye { x: 50 z: 86.60254 } target {} up { y: 1 } vertical_fov: 0.01 } "
         "light { name: 'l' direction { x: " +
         std::to_string(std::sin(light)) + " z: " + std::to_string(-std::cos(light)) +
         " } spectrum { standard: 'D65' } luminance: 0.5 } "
         "material { name: 'm' diffuseness: 0 specularness: 1 fresnel { conductor { metal: 'Cu' } "
         "} "
         "he_torrance { rms_roughness: " +
         std::to_string(patch.roughness) + " correlation_length: " + std::to_string(patch.length) +
         " } } object { name: 'o' material: 'm' quad { corner { x: -9 y: -9 } u { x: 18 } v { y: "
         "18 "
         "} } } settings { width: 1 height: 1 spp: 1 " +
         settings + " }";
}

Xyz rough_truth(const RoughPatch& patch) {
  const RenderScene scene = compile_text(rough_scene(patch, ""));
  const double light = patch.light_degrees * std::numbers::pi / 180, eye = std::numbers::pi / 6;
  const auto angles =
      models::angles_between({0, 0, 1}, {1, 0, 0}, {-std::sin(light), 0, std::cos(light)},
                             {std::sin(eye), 0, std::cos(eye)}, scene.lights[0].solid_angle);
  auto reflection = models::default_reflection(models::Model::he_torrance);
  reflection.parameters = {0, 1, patch.roughness, patch.length};
  const auto lobes = models::evaluate(reflection, angles);
  const OpticalConstants& copper = scene.constants[0];
  Xyz xyz{};
  double y = 0;
  for (double nm = 360.25; nm < 830; nm += 0.5) {
    const auto at = [&](const Spectrum& spectrum, Outside outside) {
      return resample(spectrum, {nm}, outside).values[0];
    };
    const double power = at(*cie::illuminant("D65"), Outside::zero);
    const double reflected = models::fresnel_weight(lobes, nm) *
                             models::conductor_fresnel(lobes.cosine, at(copper.n, Outside::hold),
                                                       at(copper.k, Outside::hold));
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double sees = at(cie::observer_1931().functions()[axis], Outside::zero);
      xyz[axis] += sees * power * reflected;
      if (axis == 1) y += sees * power;
    }
  }
  for (double& value : xyz) value *= 0.5 / y;
  return xyz;
}

double rough_difference(const std::array<float, 3>& one, const Xyz& other) {
  const Xyz white{0.9505, 1, 1.089};
  return delta_e_00(to_lab({one[0], one[1], one[2]}, white), to_lab(other, white));
}

TEST(RoughMetal, IsTheSumOverEveryNanometreByEachMethod) {
  struct Accuracy {
    std::string method;
    double most;  ///< ΔE00
  };
  const Accuracy methods[] = {{"exact {}", 0.02},
                              {"prefilter {}", 0.05},
                              {"point { from: 380 to: 780 step: 5 }", 0.05},
                              {"point { fitted: 8 }", 0.3},
                              {"linear { bases: 8 }", 0.8}};
  for (const RoughPatch& patch : rough_patches) {
    const Xyz truth = rough_truth(patch);
    EXPECT_GT(truth[1], 0.003) << patch.roughness << " is black";
    for (const Accuracy& one : methods)
      EXPECT_LT(rough_difference(
                    render(rough_scene(patch, "method { " + one.method + " }")).at(0, 0), truth),
                one.most)
          << patch.roughness << " by " << one.method;
  }
}

TEST(RoughMetal, MirrorsWithWhatItsRoughnessLeaves) {
  // A white card behind the eye's mirror image, seen over a rough mirror.
  const RenderScene scene = compile_text(rough_scene(rough_patches[1], ""));
  Gather gather(1);
  float weight = 1;
  RenderMaterial mirror = scene.materials[0];
  mirror.mirror = 0.5f;
  const std::uint32_t chain = over_mirror(gather, 0, mirror, 0, 0.8f, weight);
  const auto rough = models::rough_mirror({0, 1, 0.08, 3}, 0.8);
  EXPECT_NEAR(weight, 0.5 * rough.masking, 1e-6);
  EXPECT_EQ(gather.chains()[chain].factor.kind, FactorKind::coherent);
  EXPECT_NEAR(gather.chains()[chain].factor.at, rough.depth, 1e-6);
  EXPECT_EQ(gather.chains()[gather.chains()[chain].parent].factor.kind, FactorKind::fresnel);
}

/// What of a white card of equal power a mirror shows.
std::array<float, 3> seen_over_mirror(const std::string& model) {
  return render(
             "camera { eye { z: 3 } target {} vertical_fov: 1 } light { name: 'l' position { x: 2 "
             "z: 2 } spectrum { standard: 'E' } } material { name: 'm' mirror: 1 diffuseness: 0 " +
             model +
             " } material { name: 'white' diffuse { constant: 1 } } object { name: 'o' material: "
             "'m' quad { corner { x: -9 y: -9 } u { x: 18 } v { y: 18 } } } object { name: 'w' "
             "material: 'white' quad { corner { x: -9 y: -9 z: 5 } u { y: 18 } v { x: 18 } } } "
             "settings { width: 1 height: 1 spp: 1 method { exact {} } }")
      .at(0, 0);
}

TEST(RoughMetal, ShowsLessOfTheBlueInItsMirrorThanOfTheRed) {
  // exp(−g) at right angles, by a sum over 0.5 nm.
  std::array<double, 3> left{}, all{};
  for (double nm = 360.25; nm < 830; nm += 0.5)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double sees =
          resample(cie::observer_1931().functions()[axis], {nm}, Outside::zero).values[0];
      left[axis] += sees * std::exp(-std::pow(4 * std::numbers::pi * 50 / nm, 2));
      all[axis] += sees;
    }
  const auto perfect = seen_over_mirror("lambert {}"),
             rough = seen_over_mirror("he_torrance { rms_roughness: 0.05 }"),
             smooth = seen_over_mirror("he_torrance { rms_roughness: 0.001 }");
  EXPECT_GT(perfect[1], 0.1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(rough[axis] / perfect[axis], left[axis] / all[axis], 5e-4) << axis;
    EXPECT_NEAR(smooth[axis] / perfect[axis], 1, 2e-3) << axis;
  }
  EXPECT_GT(left[0] / all[0], 1.5 * left[2] / all[2]);
}

}  // namespace
}  // namespace metamer::test
