#include "server/film/develop.h"

#include <gtest/gtest.h>

#include <array>

namespace metamer {
namespace {

using Pixel = std::array<std::uint8_t, 3>;

/// One pixel of this colour, and whether it was clipped.
std::pair<Pixel, bool> develop(const v1::Plan& plan, const Xyz& xyz, float scale = 1) {
  const auto developer = Developer::make(plan);
  EXPECT_TRUE(developer);
  const std::array<float, 3> values = {static_cast<float>(xyz[0]), static_cast<float>(xyz[1]),
                                       static_cast<float>(xyz[2])};
  Pixel pixel{};
  const auto outside = developer->develop(values, scale, pixel);
  return {pixel, outside == 1};
}

TEST(Develop, TheSpacesWhiteIsItsBrightestCode) {
  for (const v1::RgbSpace space : {v1::SRGB, v1::DISPLAY_P3, v1::ADOBE_RGB, v1::REC_2020}) {
    v1::Plan plan;
    plan.mutable_development()->set_rgb_space(space);
    const Xyz white = white_xyz(rgb_space(to_standard_space(space)).primaries.white);
    const auto [pixel, clipped] = develop(plan, white);
    EXPECT_EQ(pixel, (Pixel{255, 255, 255}));
    EXPECT_FALSE(clipped);
    // Sums of four samples.
    EXPECT_EQ(develop(plan, {4 * white[0], 4 * white[1], 4 * white[2]}, 0.25f).first,
              (Pixel{255, 255, 255}));
  }
}

TEST(Develop, AdaptsTheWhiteOfThePlan) {
  v1::Plan plan;
  const Xyz lamp = {1.0985, 1, 0.3558};  // A
  for (const double value : lamp) plan.add_source_white(value);
  EXPECT_TRUE(develop(plan, lamp).second);
  plan.mutable_development()->set_adaptation(v1::BRADFORD);
  const auto [pixel, clipped] = develop(plan, lamp);
  EXPECT_EQ(pixel, (Pixel{255, 255, 255}));
  EXPECT_FALSE(clipped);
}

TEST(Develop, CountsWhatTheSpaceDoesNotHold) {
  v1::Plan plan;
  EXPECT_TRUE(develop(plan, {0.1, 0.4, 0.05}).second);  // greener than sRGB's green
  EXPECT_TRUE(develop(plan, {2, 2, 2}).second);
  EXPECT_FALSE(develop(plan, {0, 0, 0}).second);
}

TEST(Develop, LinearLeavesTheTransferOut) {
  v1::Plan plan;
  const Xyz white = white_xyz(rgb_space(StandardSpace::srgb).primaries.white);
  const Xyz grey = {0.2 * white[0], 0.2 * white[1], 0.2 * white[2]};
  EXPECT_EQ(develop(plan, grey).first, (Pixel{124, 124, 124}));
  plan.mutable_development()->set_linear(true);
  EXPECT_EQ(develop(plan, grey).first, (Pixel{51, 51, 51}));
}

}  // namespace
}  // namespace metamer
