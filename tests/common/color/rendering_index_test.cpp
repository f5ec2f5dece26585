#include "common/color/rendering_index.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/color/radiators.h"
#include "common/spectral/cie.h"

namespace metamer {
namespace {

TEST(RenderingIndex, IsThePublishedOne) {
  // CIE 15:2004, table T.8 (whole numbers); A is its own reference.
  const std::pair<const char*, double> published[] = {
      {"A", 100}, {"F1", 76}, {"F2", 64}, {"F3", 57},  {"F4", 51},  {"F5", 72}, {"F6", 59},
      {"F7", 90}, {"F8", 95}, {"F9", 90}, {"F10", 81}, {"F11", 83}, {"F12", 83}};
  for (const auto& [light, ra] : published) {
    const auto found = rendering_index(*cie::illuminant(light));
    ASSERT_TRUE(found) << light;
    EXPECT_EQ(std::round(found->ra), ra) << light << " " << found->ra;
  }
}

TEST(RenderingIndex, SaysHowTintedALightIs) {
  // F5 lies above the locus (Duv from CIE 15's x 0.3138, y 0.3452), F7 on it.
  EXPECT_GT(rendering_index(*cie::illuminant("F5"))->distance, RenderingIndex::tolerance);
  EXPECT_LT(rendering_index(*cie::illuminant("F7"))->distance, RenderingIndex::tolerance);
}

TEST(RenderingIndex, OfAReferenceIs100ForEveryColour) {
  std::vector<double> nm;
  for (int i = 360; i <= 830; i += 5) nm.push_back(i);
  for (const Spectrum& light : {planckian(2000, nm), planckian(4990, nm)}) {
    const auto found = rendering_index(light);
    ASSERT_TRUE(found);
    for (const double each : found->each) EXPECT_NEAR(each, 100, 0.05);
  }
  // A phase of daylight lies beside the Planckian locus; its temperature, by its formula or by its
  // chromaticity, differs a little.
  for (const double kelvin : {5100.0, 6504.0, 20000.0}) {
    const auto found = rendering_index(daylight(kelvin, nm));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->kelvin, kelvin, 2e-3 * kelvin);
    for (const double each : found->each) EXPECT_NEAR(each, 100, 0.2);
  }
}

TEST(RenderingIndex, DoesNotDependOnTheLuminance) {
  Spectrum light = *cie::illuminant("F4");
  const double ra = rendering_index(light)->ra;
  for (double& value : light.values) value *= 1e-300;
  EXPECT_NEAR(rendering_index(light)->ra, ra, 1e-9);
  for (double& value : light.values) value *= 1e300;
  for (double& value : light.values) value *= 1e300;
  EXPECT_NEAR(rendering_index(light)->ra, ra, 1e-9);
}

TEST(RenderingIndex, OfFineSamplesKeepsTheirLines) {
  // Two lines between the CIE's positions and a body: at 5 nm they would not be there.
  std::vector<double> nm, values;
  for (int i = 380; i <= 780; ++i) {
    nm.push_back(i);
    values.push_back(i == 546 || i == 612 ? 30 : 1);
  }
  const auto with = rendering_index({nm, values});
  const auto without = rendering_index({{380, 780}, {1, 1}});
  ASSERT_TRUE(with && without);
  EXPECT_LT(with->ra, without->ra - 2);
}

std::string error_of(const Spectrum& light) {
  const auto found = rendering_index(light);
  return found ? "" : found.error().message;
}

TEST(RenderingIndex, OfWhatIsNoWhiteLightIsAnError) {
  EXPECT_EQ(error_of({{400, 700}, {0, 0}}), "a light that nobody sees renders no colours");
  EXPECT_EQ(error_of({{900, 1000}, {1, 1}}), "a light that nobody sees renders no colours");
  EXPECT_EQ(error_of({{400, 500, 700}, {1, -1, 1}}), "a light has no power below 0");
  const char* nothing_like_it = "no black body or daylight of 1000 to 25000 K is like this light";
  EXPECT_EQ(error_of({{549, 550, 551}, {0, 1, 0}}), nothing_like_it);
  EXPECT_EQ(error_of(planckian(40000, {380, 480, 580, 680, 780})), nothing_like_it);
}

}  // namespace
}  // namespace metamer
