// Trichromatic values of spectra, against what follows from the definitions.
#include "client/tools/spectra/spectrum_rgb.h"

#include <gtest/gtest.h>

namespace metamer::client {
namespace {

v1::Development development(v1::RgbSpace space, v1::Adaptation adaptation, bool linear = false) {
  v1::Development result;
  result.set_rgb_space(space);
  result.set_adaptation(adaptation);
  result.set_linear(linear);
  return result;
}

SpectrumRgb rgb_of(const Spectrum& spectrum, bool emission, const char* light,
                   const v1::Development& how, double luminance = 1) {
  const auto rgb =
      spectrum_rgb({"", "", emission ? Quantity::emission : Quantity::reflectance, spectrum},
                   *cie::illuminant(light), cie::observer_1931(), luminance, how);
  EXPECT_TRUE(rgb);
  return *rgb;
}

TEST(SpectrumRgb, AnAdaptedGreyIsItsReflectanceInEachChannel) {
  for (const char* light : {"A", "F2", "D65"})
    for (const auto space : {v1::SRGB, v1::REC_2020, v1::PROPHOTO}) {
      const SpectrumRgb rgb =
          rgb_of({{500}, {0.36}}, false, light, development(space, v1::BRADFORD));
      for (const double value : rgb.linear) EXPECT_NEAR(value, 0.36, 1e-12) << light;
      EXPECT_DOUBLE_EQ(rgb.encoded[0], encode(rgb.space.transfer, rgb.linear[0]));
      EXPECT_TRUE(rgb.in_gamut);
    }
}

TEST(SpectrumRgb, D65IsSrgbsWhiteToTheDigitsOfItsStandard) {
  // IEC 61966-2-1 rounds the white to x 0.3127, y 0.3290.
  const SpectrumRgb rgb =
      rgb_of(*cie::illuminant("D65"), true, "A", development(v1::SRGB, v1::NO_ADAPTATION));
  for (const double value : rgb.linear) EXPECT_NEAR(value, 1, 1e-3);
  EXPECT_NEAR(rgb.xyz[1], 1, 1e-14);
}

TEST(SpectrumRgb, LuminanceScalesAndLinearIsNotEncoded) {
  const auto linear = development(v1::SRGB, v1::NO_ADAPTATION, true);
  const SpectrumRgb one = rgb_of(*cie::illuminant("F4"), true, "A", linear);
  const SpectrumRgb three = rgb_of(*cie::illuminant("F4"), true, "A", linear, 3);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(three.linear[c], 3 * one.linear[c], 1e-14);
  EXPECT_EQ(one.encoded, one.linear);
  EXPECT_FALSE(three.in_gamut);
}

TEST(SpectrumRgb, ASpectralColourLiesOutsideEverySpaceOfRealPrimaries) {
  const SpectrumRgb rgb =
      rgb_of({{505}, {1}}, true, "D65", development(v1::SRGB, v1::NO_ADAPTATION), 0.1);
  EXPECT_LT(rgb.linear[0], 0);
  EXPECT_FALSE(rgb.in_gamut);
}

TEST(SpectrumRgb, UnderADarkLightAllIs0) {
  const LoadedSpectrum paint{"", "", Quantity::reflectance, {{500}, {1}}};
  const auto rgb = spectrum_rgb(paint, {{400, 700}, {0, 0}}, cie::observer_1964(), 1,
                                development(v1::SRGB, v1::BRADFORD));
  ASSERT_TRUE(rgb);
  EXPECT_TRUE(rgb->dark);
  EXPECT_EQ(rgb->linear, (Rgb{0, 0, 0}));
  EXPECT_NE(rgb->unadapted, "");
}

TEST(SpectrumRgb, PrimariesOnALineMakeNoSpace) {
  v1::Development how;
  v1::Primaries& primaries = *how.mutable_primaries();
  for (auto* one : {primaries.mutable_red(), primaries.mutable_green(), primaries.mutable_blue(),
                    primaries.mutable_white()})
    one->Resize(2, 0.3);
  const LoadedSpectrum light{"", "", Quantity::emission, *cie::illuminant("A")};
  EXPECT_FALSE(spectrum_rgb(light, light.spectrum(), cie::observer_1931(), 1, how));
}

}  // namespace
}  // namespace metamer::client
