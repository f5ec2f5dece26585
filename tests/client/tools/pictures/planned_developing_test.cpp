// What a plan says of the picture's colours, made ready for a file.
#include "client/tools/pictures/planned_developing.h"

#include <gtest/gtest.h>

namespace metamer::client {
namespace {

v1::Plan plan_of(v1::Adaptation adaptation, v1::RgbSpace space, const std::vector<double>& white) {
  v1::Plan plan;
  plan.mutable_development()->set_adaptation(adaptation);
  plan.mutable_development()->set_rgb_space(space);
  plan.mutable_source_white()->Add(white.begin(), white.end());
  return plan;
}

TEST(PlannedDeveloping, TurnsTheDominantLightsWhiteIntoRgbOfOnes) {
  const std::vector<double> a = {1.0985, 1, 0.3558};
  for (const v1::Adaptation adaptation : {v1::VON_KRIES, v1::BRADFORD, v1::SHARP, v1::CMCCAT2000})
    for (const v1::RgbSpace space :
         {v1::SRGB, v1::DISPLAY_P3, v1::ADOBE_RGB, v1::PROPHOTO, v1::REC_2020, v1::CIE_RGB}) {
      const auto planned = planned_developing(plan_of(adaptation, space, a));
      ASSERT_TRUE(planned);
      EXPECT_EQ(planned->unadapted, "");
      const Rgb white = multiply(planned->developing.space.from_xyz,
                                 multiply(planned->developing.adaptation, Xyz{a[0], a[1], a[2]}));
      for (const double value : white) EXPECT_NEAR(value, 1, 1e-13);
    }
}

TEST(PlannedDeveloping, IsPlainSrgbWhereAPlanSaysNothing) {
  const auto planned = planned_developing({});
  ASSERT_TRUE(planned);
  EXPECT_EQ(planned->developing.space.word, "srgb");
  EXPECT_EQ(planned->developing.adaptation, identity3);
  EXPECT_FALSE(planned->developing.linear);
  EXPECT_EQ(planned->unadapted, "");
}

TEST(PlannedDeveloping, SaysWhyItCannotAdapt) {
  const auto dark = planned_developing(plan_of(v1::BRADFORD, v1::SRGB, {}));
  ASSERT_TRUE(dark);
  EXPECT_EQ(dark->unadapted, "the dominant light has no white");
  EXPECT_EQ(dark->developing.adaptation, identity3);
  const auto red = planned_developing(plan_of(v1::SHARP, v1::SRGB, {2.8, 1, 0}));
  ASSERT_TRUE(red);
  EXPECT_EQ(red->unadapted.substr(0, 30), "no eye adapts to a white of X ");
}

TEST(PlannedDeveloping, ExposureDoublesWithEachStopAndAWhitesLuminanceBecomesOne) {
  v1::Plan plan = plan_of(v1::BRADFORD, v1::PROPHOTO, {1.0985, 1, 0.3558});
  const Matrix3 plain = planned_developing(plan)->developing.adaptation;
  const auto expect_times = [&](double factor) {
    const Matrix3 own = planned_developing(plan)->developing.adaptation;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) EXPECT_DOUBLE_EQ(own[i][j], factor * plain[i][j]);
  };
  for (const auto& [stops, factor] : {std::pair{0.0, 1.0}, {3.0, 8.0}, {-1.0, 0.5}}) {
    plan.mutable_development()->set_exposure(stops);
    expect_times(factor);
  }
  plan.mutable_development()->set_white_luminance(0.25);  // in the place of the exposure
  expect_times(4);
}

TEST(PlannedDeveloping, RefusesASpaceThatThereCannotBe) {
  v1::Plan plan;
  plan.mutable_development()->mutable_primaries()->add_red(0.5);
  const auto planned = planned_developing(plan);
  ASSERT_FALSE(planned);
  EXPECT_EQ(planned.error().message, "red must be x and y (it has 1 number)");
}

}  // namespace
}  // namespace metamer::client
