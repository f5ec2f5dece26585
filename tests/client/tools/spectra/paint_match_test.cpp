#include "client/tools/spectra/paint_match.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "client/tools/pictures/swatches.h"
#include "common/spectral/cie.h"

namespace metamer::client {
namespace {

std::vector<NamedSpectrum> lights_of_day_and_shop() {
  return {{"D65", *cie::illuminant("D65")}, {"F11", *cie::illuminant("F11")}};
}

TEST(PaintMatch, FindsTheOneWhoseWorstLightIsBest) {
  const Spectrum& paint = *cie::test_color("TCS09");
  const std::vector<NamedSpectrum> candidates = {
      {"near", *cie::test_color("TCS01")}, {"same", paint}, {"far", *cie::test_color("TCS12")}};
  const auto matches =
      match_paints(paint, candidates, lights_of_day_and_shop(), cie::observer_1931());
  ASSERT_TRUE(matches);
  ASSERT_EQ(matches->size(), 3U);
  EXPECT_EQ(nearest(*matches).name, "same");
  EXPECT_EQ(nearest(*matches).worst_de00(), 0);
  for (const PaintMatch& match : *matches) {
    EXPECT_NEAR(match.index.front().de00, 0, 1e-9) << "under the reference";
    for (const Mismatch& under : match.under) EXPECT_LE(under.de00, match.worst_de00());
  }
}

TEST(PaintMatch, TellsALightThatNobodySees) {
  const Spectrum grey = {{500}, {0.5}};
  const auto matches =
      match_paints(grey, {{"b", grey}}, {{"heat", {{900, 1000}, {1, 1}}}}, cie::observer_1931());
  EXPECT_FALSE(matches);
}

TEST(PaintMatch, FindsAMetamericPairAmongPaints) {
  const auto lights = lights_of_day_and_shop();
  const Spectrum& paint = *cie::test_color("TCS02");
  const auto metamer =
      make_metamer(paint, lights[0].spectrum, lights[1].spectrum, cie::observer_1931());
  ASSERT_TRUE(metamer);
  std::vector<NamedSpectrum> paints = {{"red", *cie::test_color("TCS09")},
                                       {"paint", paint},
                                       {"the same", paint},
                                       {"green", *cie::test_color("TCS11")}};
  EXPECT_FALSE(metameric_pair(paints, lights, cie::observer_1931()));
  paints.push_back({"metamer", metamer->reflectance});
  const auto pair = metameric_pair(paints, lights, cie::observer_1931());
  ASSERT_TRUE(pair);
  EXPECT_EQ(pair->first, 1u);
  EXPECT_EQ(pair->second, 4u);
  EXPECT_FALSE(metameric_pair({}, lights, cie::observer_1931()));
}

TEST(Swatches, HaveTheReferenceAtTheLeft) {
  const Spectrum grey = {{500}, {0.5}}, black = {{500}, {0}};
  const auto matches = match_paints(grey, {{"black", black}, {"grey", grey}},
                                    lights_of_day_and_shop(), cie::observer_1931());
  ASSERT_TRUE(matches);
  const auto drawn = swatches(*matches);
  ASSERT_TRUE(drawn) << drawn.error().message;
  const Image& image = *drawn;
  constexpr int column = swatch_size + swatch_gap, half = swatch_size / 2;
  constexpr int row = column + swatch_text, top = swatch_text + swatch_gap;
  EXPECT_EQ(image.width, swatch_names + 2 * column + swatch_gap);
  EXPECT_EQ(image.height, swatch_text + 2 * row + swatch_gap);
  EXPECT_NEAR(image.at(0, 0)[1], 0.2, 1e-6) << "the ground";
  for (const int left : {swatch_names, swatch_names + column}) {
    EXPECT_NEAR(image.at(left, top)[1], 0.5, 1e-6);
    EXPECT_EQ(image.at(left + half, top)[1], 0);
    EXPECT_NEAR(image.at(left + half, top + row)[1], 0.5, 1e-6);
    // A grey is D65's under each light, as eyes are adapted to it.
    EXPECT_NEAR(image.at(left, top)[0], 0.5 * 0.95047, 1e-4);
    EXPECT_NEAR(image.at(left, top)[2], 0.5 * 1.08883, 2e-4);
  }
}

TEST(Swatches, HaveLabels) {
  const Spectrum grey = {{500}, {0.5}};
  const auto matches =
      match_paints(grey, {{"a", grey}}, lights_of_day_and_shop(), cie::observer_1931());
  ASSERT_TRUE(matches);
  const auto drawn = swatches(*matches);
  ASSERT_TRUE(drawn);
  const auto brightest = [&](int left, int top, int right, int bottom) {
    float most = 0;
    for (int y = top; y < bottom; ++y)
      for (int x = left; x < right; ++x) most = std::max(most, drawn->at(x, y)[1]);
    return most;
  };
  const int below = swatch_text + swatch_gap + swatch_size;
  EXPECT_GT(brightest(swatch_names, 0, drawn->width, swatch_text), 0.8) << "the lights";
  EXPECT_GT(brightest(0, swatch_text, swatch_names, below), 0.8) << "the candidate";
  EXPECT_GT(brightest(swatch_names, below, drawn->width, drawn->height), 0.8) << "the differences";
}

}  // namespace
}  // namespace metamer::client
