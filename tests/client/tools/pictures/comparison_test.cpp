// Two picture files as X Y Z, against published colours and differences.
#include "client/tools/pictures/comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/color/lab.h"
#include "common/image/spectral_exr.h"
#include "tests/client/tools/temporary_folder.h"

namespace metamer::client {
namespace {

/// A picture one pixel high.
Image row_of(const std::vector<Xyz>& pixels) {
  Image image = make_image(static_cast<int>(pixels.size()), 1, {"X", "Y", "Z"});
  for (std::size_t i = 0; i < pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      image.at(static_cast<int>(i), 0)[c] = static_cast<float>(pixels[i][c]);
  return image;
}

/// CIE 15:2004, 8.2.1, solved for X Y Z.
Xyz xyz_of(const Lab& lab, const Xyz& white) {
  const auto inverse = [](double f) { return f > 6. / 29 ? f * f * f : (f - 4. / 29) * 108 / 841; };
  const double f = (lab.l + 16) / 116;
  return {white[0] * inverse(f + lab.a / 500), white[1] * inverse(f),
          white[2] * inverse(f - lab.b / 200)};
}

TEST(Comparison, WhatIsNotSeenIsNoWhite) {
  const Observer two = cie::observer_1931();
  EXPECT_FALSE(white_under("uv", {{200, 350}, {1, 1}}, two));
  EXPECT_FALSE(white_under("dark", {{400, 700}, {0, 0}}, two));
  EXPECT_NEAR(white_under("D65", *cie::illuminant("D65"), two)->xyz[2], 1.08883, 5e-5)
      << "ASTM E308-01, table 5";
}

TEST(Comparison, WhitesAreThePublishedOnes) {
  // ASTM E308-01, table 5. D50's table has three digits, from 380 to 780 nm.
  struct Published {
    const char* light;
    Observer observer;
    double x, z, tolerance;
  };
  for (const Published& one : {Published{"A", cie::observer_1931(), 1.09850, 0.35585, 5e-5},
                               Published{"D50", cie::observer_1931(), 0.96422, 0.82521, 5e-4},
                               Published{"D65", cie::observer_1931(), 0.95047, 1.08883, 5e-5},
                               Published{"A", cie::observer_1964(), 1.11144, 0.35200, 5e-5},
                               Published{"D65", cie::observer_1964(), 0.94811, 1.07304, 5e-5}}) {
    const Xyz white = white_of(*cie::illuminant(one.light), one.observer);
    EXPECT_NEAR(white[0], one.x, one.tolerance) << one.light;
    EXPECT_NEAR(white[1], 1, 1e-14) << one.light;
    EXPECT_NEAR(white[2], one.z, one.tolerance) << one.light;
  }
  EXPECT_NEAR(srgb_white().xyz[0], 0.3127 / 0.3290, 1e-12);
}

TEST(Comparison, PairsOfSharmaWuAndDalalThroughFiles) {
  // The first, the seventh, the seventeenth and the last of their table 1, with the white of D65.
  struct Pair {
    Lab one, other;
    double de00;
  };
  const std::vector<Pair> published = {
      {{50, 2.6772, -79.7751}, {50, 0, -82.7485}, 2.0425},
      {{50, 0, 0}, {50, -1, 2}, 2.3669},
      {{50, 2.5, 0}, {73, 25, -18}, 27.1492},
      {{2.0776, 0.0795, -1.1350}, {0.9033, -0.0636, -0.5514}, 0.9082}};
  const Xyz white = white_of(*cie::illuminant("D65"), cie::observer_1931());
  std::vector<Xyz> one, other;
  for (const Pair& pair : published) {
    one.push_back(xyz_of(pair.one, white));
    other.push_back(xyz_of(pair.other, white));
  }
  const TemporaryFolder folder;
  const std::array<std::string, 2> files = {folder.file("a.exr"), folder.file("b.exr")};
  ASSERT_TRUE(write_image(row_of(one), files[0], true, {}));
  ASSERT_TRUE(write_image(row_of(other), files[1], true, {}));

  const auto pictures = read_pair(files, {});
  ASSERT_TRUE(pictures);
  const auto difference = compare((*pictures)[0].image, (*pictures)[1].image, Metric::de00, white);
  ASSERT_TRUE(difference);
  for (std::size_t i = 0; i < published.size(); ++i)
    EXPECT_NEAR(difference->values[i], published[i].de00, 2e-4) << i;
  EXPECT_EQ(pixel_at(difference->statistics.at, difference->width), (Pixel{2, 0}));
  EXPECT_TRUE(is_over(difference->statistics, 27));
  EXPECT_FALSE(is_over(difference->statistics, 28));
}

TEST(Comparison, ReportsBothFilesThatCanNotBeRead) {
  const TemporaryFolder folder;
  const std::string text = folder.write("a.png", "no picture");
  const auto pictures = read_pair({folder.file("none.exr"), text}, {});
  ASSERT_FALSE(pictures);
  ASSERT_EQ(pictures.error().size(), 2u);
  EXPECT_EQ(pictures.error()[0].file, folder.file("none.exr"));
  EXPECT_EQ(pictures.error()[1].file, text);
}

TEST(Comparison, AReflectanceNeedsALight) {
  const TemporaryFolder folder;
  const std::string file = folder.file("paint.exr");
  const SpectralImage grey{.width = 1,
                           .height = 1,
                           .reflectance = true,
                           .nm = {400, 700},
                           .values = {0.25f, 0.25f},
                           .units = {},
                           .polarised = false};
  ASSERT_TRUE(write_spectral_exr(grey, row_of({{0, 0, 0}}), file, {}));
  EXPECT_FALSE(read_pair({file, file}, {}));
  const Viewing viewing{.observer = cie::observer_1931(), .under = cie::illuminant("F2")};
  const auto lit = read_pair({file, file}, viewing);
  ASSERT_TRUE(lit);
  EXPECT_TRUE((*lit)[0].lit);
  // The eye sums over the picture's two wavelengths, and so over those of its white.
  EXPECT_GT((*lit)[0].image.pixels[1], 0);
}

TEST(Comparison, UnitsAreTheSameWhereOneIsNotSaid) {
  const auto pair = [](const char* a, const char* b) {
    PicturePair pictures;
    pictures[0].units = a;
    pictures[1].units = b;
    return same_units(pictures).has_value();
  };
  EXPECT_TRUE(pair("W.m^-2.sr^-1", "W.m^-2.sr^-1"));
  EXPECT_TRUE(pair("", "W.m^-2.sr^-1"));
  EXPECT_FALSE(pair("W.m^-2.sr^-1", "W.m^-2.sr^-1.nm^-1"));
}

TEST(Comparison, PlacesThePixelThatIsNoColourAndThePictureItIsIn) {
  const float infinite = std::numeric_limits<float>::infinity();
  const Xyz white = srgb_white().xyz, grey{0.2, 0.2, 0.2};
  const Image sound = row_of({grey, grey, grey});
  Image broken = sound;
  broken.at(1, 0)[2] = infinite;
  broken.at(2, 0)[0] = NAN;
  const Difference second = *compare(sound, broken, Metric::deab, white);
  EXPECT_EQ(first_not_finite(second, sound)->picture, 1u);
  EXPECT_EQ(first_not_finite(second, sound)->pixel, (Pixel{1, 0}));
  EXPECT_TRUE(is_over(second.statistics, 1e9)) << "it keeps to no limit";
  EXPECT_EQ(first_not_finite(*compare(broken, sound, Metric::deab, white), broken)->picture, 0u);
  EXPECT_FALSE(first_not_finite(*compare(sound, sound, Metric::deab, white), sound));
}

}  // namespace
}  // namespace metamer::client
