#include "common/scene/fresnel_table.h"

#include <gtest/gtest.h>

#include "common/color/xyz.h"
#include "common/models/reference.h"
#include "common/spectral/optical_constants.h"
#include "server/methods/method.h"
#include "server/transport/mirror.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

std::vector<std::pair<std::string, OpticalConstants>> all_constants() {
  std::vector<std::pair<std::string, OpticalConstants>> all;
  for (const Metal& metal : metals()) all.push_back({metal.name, {metal.n, metal.k}});
  const AssetReader none = [](const std::string&) -> Result<std::string> { return problem(""); };
  for (const Medium& medium : media()) {
    v1::Fresnel fresnel;
    fresnel.mutable_dielectric()->set_medium(medium.name);
    all.push_back({medium.name, *load_fresnel(fresnel, "", none)});
  }
  return all;
}

TEST(FresnelTable, ALineBetweenTwoNodesIsTheTermTo2e5ForEveryShippedMetalAndMedium) {
  const Wavelengths wavelengths = *Wavelengths::uniform(380, 780, 20);
  for (const auto& [name, constants] : all_constants()) {
    const ConstantsAt at = resample(constants, wavelengths.nm());
    double worst = 0;
    for (int i = 0; i <= 3000; ++i) {
      const auto cosine = static_cast<float>(i / 3000.0);
      const FresnelPlace place = fresnel_place(cosine);
      ASSERT_LT(place.below + 1, fresnel_nodes);
      ASSERT_TRUE(place.fraction >= -1e-4f && place.fraction <= 1.0001f) << cosine;
      const auto below = fresnel_at(at, fresnel_node(place.below));
      const auto above = fresnel_at(at, fresnel_node(place.below + 1));
      const auto exact = fresnel_at(at, cosine);
      for (std::size_t k = 0; k < exact.size(); ++k)
        worst =
            std::max(worst, std::abs(below[k] + place.fraction * (above[k] - below[k]) - exact[k]));
    }
    EXPECT_LT(worst, 2e-5) << name;
  }
}

/// What one light gives over a spectrum of reflection, in f64.
Xyz lit(const Wavelengths& wavelengths, const std::string& light,
        const std::vector<double>& reflection) {
  const ObserverWeights observer = observer_weights(cie::observer_1931(), wavelengths);
  auto power = resample(*cie::illuminant(light), wavelengths.nm(), Outside::zero).values;
  const double scale = luminance_scale(observer, power, 1);
  for (std::size_t i = 0; i < power.size(); ++i) power[i] *= scale * reflection[i];
  return to_xyz(observer, power);
}

/// A picture of one pixel: light and eye at the same angle on either side of a small card's normal,
/// so that its middle mirrors the light with N·H = 1 and V·H = the cosine of that angle.
std::string card(double degrees, const std::string& material) {
  const double a = degrees * std::numbers::pi / 180;
  const std::string x = std::to_string(3 * std::sin(a)), z = std::to_string(3 * std::cos(a));
  return "camera { eye { x: -" + x + " z: " + z + " } target {} vertical_fov: 0.01 } " +
         "light { name: 'l' position { x: " + x + " z: " + z +
         " } spectrum { standard: 'F11' } } material { name: 'm' diffuseness: 0 specularness: "
         "0.5 " +
         material +
         " } object { name: 'o' material: 'm' quad { corner { x: -1 y: -1 } u { x: 2 } v { y: 2 } "
         "} } settings { width: 1 height: 1 spp: 1 method { point { from: 400 to: 700 step: 10 "
         "lights: SAMPLES } } "
         "}";
}

TEST(FresnelTable, AHighlightHasTheColourOfItsTermAtItsAngle) {
  const Wavelengths wavelengths = *Wavelengths::uniform(400, 700, 10);
  for (const auto& [name, constants] : all_constants())
    for (const double degrees : {0.0, 40.0, 75.0, 88.0}) {
      const bool metal = !constants.k.nm.empty();
      const auto picture = test::render(
          card(degrees, std::string("hall_greenberg { shininess: 1 } fresnel { ") +
                            (metal ? "conductor { metal: '" : "dielectric { medium: '") + name +
                            "' } }"));
      auto term = fresnel_at(resample(constants, wavelengths.nm()),
                             std::cos(degrees * std::numbers::pi / 180));
      for (double& value : term) value *= 0.5;
      const Xyz exact = lit(wavelengths, "F11", term);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(picture.at(0, 0)[i], exact[i], 3e-5) << name << " at " << degrees << "°";
    }
}

TEST(FresnelTable, SchlicksTermSplitsIntoColourAndWhite) {
  const Wavelengths wavelengths = *Wavelengths::uniform(400, 700, 10);
  for (const double degrees : {0.0, 60.0, 85.0}) {
    const auto picture =
        test::render(card(degrees,
                          "specular { samples { wavelength: [400, 700] value: [0.1, 0.9] } } "
                          "hall_greenberg { shininess: 1 } fresnel { schlick {} }"));
    std::vector<double> term;
    for (const double nm : wavelengths.nm())
      term.push_back(0.5 * models::schlick_fresnel(std::cos(degrees * std::numbers::pi / 180),
                                                   0.1 + 0.8 * (nm - 400) / 300));
    const Xyz exact = lit(wavelengths, "F11", term);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(picture.at(0, 0)[i] / exact[i], 1, 1e-5) << degrees;
  }
}

TEST(FresnelTable, AMirrorHasTheColourOfItsTermAtNV) {
  const RenderScene scene = test::compile_text(R"(
    camera { eye { z: 3 } target {} }
    light { name: "l" position { y: 2 } spectrum { standard: "A" } }
    material { name: "white" diffuse { constant: 1 } }
    material { name: "gold" mirror: 1 fresnel { conductor { metal: "Au" } } }
    material { name: "lacquer" mirror: 1 specular { constant: 0.04 } fresnel { schlick {} } }
    object { name: "o" material: "white" sphere { radius: 1 } })");
  const Wavelengths wavelengths = *Wavelengths::uniform(400, 700, 10);
  v1::Plan plan;
  plan.mutable_method()->mutable_point()->set_from(400);
  plan.mutable_method()->mutable_point()->set_to(700);
  plan.mutable_method()->mutable_point()->set_step(10);
  const auto method = make_method(plan, scene);

  // Two samples of one pixel, over both mirrors, at different angles.
  Gather gather(1);
  std::vector<double> expected(wavelengths.size());
  const ConstantsAt gold = resample(scene.constants[0], wavelengths.nm());
  for (const auto& [u, v, weight] : {std::tuple{0.9f, 0.3f, 0.25f}, {0.2f, 0.05f, 0.5f}}) {
    const auto once = gather.chain(0, mirror_factor(scene.materials[1], 1, u));
    const auto chain = gather.chain(once, mirror_factor(scene.materials[2], 2, v));
    gather.weights(gather.surface(chain, 0), 0) = {weight, 0, 0};
    const auto first = fresnel_at(gold, u);
    for (std::size_t i = 0; i < expected.size(); ++i)
      expected[i] += weight * first[i] * models::schlick_fresnel(double{v}, 0.04);
  }
  const auto xyz = test::resolve(*method, gather);
  const Xyz exact = lit(wavelengths, "A", expected);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(xyz[i] / exact[i], 1, 3e-5);
}

}  // namespace
}  // namespace metamer
