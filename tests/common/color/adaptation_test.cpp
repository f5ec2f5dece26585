#include "common/color/adaptation.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamer {
namespace {

const Xyz white_a = {1.09850, 1, 0.35585}, white_d65 = {0.95047, 1, 1.08883},
          white_d50 = {0.96422, 1, 0.82521};

std::vector<Adaptation> all() {
  std::vector<Adaptation> found;
  for (const std::string& word : adaptation_words()) found.push_back(*find_adaptation(word));
  return found;
}

TEST(Adaptation, OfBradfordIsThePublishedMatrix) {
  // The matrix of the ICC's profiles, D65 to D50 (ICC.1:2010, annex E, chromaticAdaptationTag).
  const Matrix3 published = {
      {{1.0478, 0.0229, -0.0501}, {0.0295, 0.9905, -0.0171}, {-0.0092, 0.0150, 0.7521}}};
  const Matrix3 own = *adaptation_matrix(Adaptation::bradford, white_d65, white_d50);
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 3; ++column)
      EXPECT_NEAR(own[row][column], published[row][column], 6e-5);
}

TEST(Adaptation, TurnsOneWhiteIntoTheOtherAndGreyIntoGrey) {
  for (const Adaptation adaptation : all()) {
    if (adaptation == Adaptation::none) continue;
    const Matrix3 matrix = *adaptation_matrix(adaptation, white_a, white_d65);
    const Xyz grey = multiply(matrix, Xyz{0.18 * white_a[0], 0.18 * white_a[1], 0.18 * white_a[2]});
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(grey[c], 0.18 * white_d65[c], 1e-15);
  }
}

TEST(Adaptation, BetweenEqualWhitesIsIdentityAndBackIsTheInverse) {
  for (const Adaptation adaptation : all()) {
    const Matrix3 same = *adaptation_matrix(adaptation, white_a, white_a);
    const Matrix3 there = *adaptation_matrix(adaptation, white_a, white_d65);
    const Matrix3 back = *adaptation_matrix(adaptation, white_d65, white_a);
    const Matrix3 round = multiply(back, there);
    for (std::size_t row = 0; row < 3; ++row)
      for (std::size_t column = 0; column < 3; ++column) {
        EXPECT_NEAR(same[row][column], identity3[row][column], 1e-15);
        EXPECT_NEAR(round[row][column], identity3[row][column], 1e-14);
      }
  }
}

TEST(Adaptation, OfNoneLeavesEverythingAlone) {
  EXPECT_EQ(*adaptation_matrix(Adaptation::none, white_a, {0, 0, 0}), identity3);
}

TEST(Adaptation, ToAWhiteWithoutAResponseIsAnError) {
  // 480 nm, CIE 1931: the sharpened long-wave response to it is below 0.
  const auto matrix =
      adaptation_matrix(Adaptation::sharp, {0.0956 / 0.139, 1, 0.813 / 0.139}, white_d65);
  ASSERT_FALSE(matrix);
  EXPECT_EQ(matrix.error().message.substr(0, 30), "no eye adapts to a white of X ");
  EXPECT_FALSE(adaptation_matrix(Adaptation::bradford, {0, 0, 0}, white_d65));
  EXPECT_FALSE(adaptation_matrix(Adaptation::bradford, {std::nan(""), 1, 1}, white_d65));
  EXPECT_FALSE(adaptation_matrix(Adaptation::bradford, {1e-320, 1e-320, 1e-320}, white_d65));
}

}  // namespace
}  // namespace metamer
