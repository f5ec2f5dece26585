// Exports of instruments, as people have them. The files are made by hand after public reports.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "common/color/xyz.h"
#include "common/spectral/files/interpret.h"

namespace metamer {
namespace {

std::string export_named(const std::string& name) {
  std::ifstream stream(METAMER_TEST_DATA "/common/spectral/files/data/" + name, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

SpectrumFile file_named(const std::string& name, std::optional<WavelengthUnit> unit = {}) {
  auto read = read_spectrum_file(export_named(name), name, unit);
  if (!read) ADD_FAILURE() << format(read.error());
  return read ? std::move(*read) : SpectrumFile{};
}

TEST(Exports, OfI1ProfilerAreAlikeInEverySpelling) {
  const SpectrumFile expected = file_named("nm.txt");
  ASSERT_EQ(expected.spectra.size(), 3U);
  EXPECT_EQ(expected.spectra[0].name, "A1");
  EXPECT_EQ(expected.spectra[1].spectrum.values[15], 0.41);
  for (const char* name : {"spectral_nm.txt", "r_.txt", "nm_utf16.txt"}) {
    const SpectrumFile file = file_named(name);
    ASSERT_EQ(file.spectra.size(), 3U) << name;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(file.spectra[i].name, expected.spectra[i].name) << name;
      EXPECT_EQ(file.spectra[i].spectrum, expected.spectra[i].spectrum) << name;
    }
  }
  const SpectrumFile latin = file_named("nm_latin1.txt");
  EXPECT_EQ(latin.spectra.at(0).name, "Grün");
  EXPECT_EQ(latin.spectra.at(0).spectrum, expected.spectra[0].spectrum);
  // Values that are divided by SPECTRAL_NORM lose a digit.
  const SpectrumFile percent = file_named("spec_percent.ti3");
  for (std::size_t k = 0; k < 36; ++k)
    EXPECT_DOUBLE_EQ(percent.spectra.at(2).spectrum.values[k],
                     expected.spectra[2].spectrum.values[k]);
}

/// x, y under the 2° observer, from an independent sum.
void expect_chromaticity(const std::string& name, double x, double y) {
  const SpectrumFile file = file_named(name);
  const auto light =
      interpret(file, file.spectra.at(0).spectrum, {.as = Quantity::emission}, Use::any);
  ASSERT_TRUE(light) << name;
  const Xyz xyz = emission_xyz(light->spectrum, cie::observer_1931());
  const double sum = xyz[0] + xyz[1] + xyz[2];
  EXPECT_NEAR(xyz[0] / sum, x, 1e-4) << name;
  EXPECT_NEAR(xyz[1] / sum, y, 1e-4) << name;
}

TEST(Exports, OfLampsHaveTheRightChromaticity) {
  expect_chromaticity("oceanview.txt", 0.36473, 0.38132);
  expect_chromaticity("pairs_neg.txt", 0.36473, 0.38132);
  expect_chromaticity("lamp_w.txt", 0.4475, 0.4074);
  expect_chromaticity("lamp_emis.sp", 0.4475, 0.4074);
}

TEST(Exports, SayWhatTheyMeasure) {
  EXPECT_EQ(file_named("lamp_emis.sp").quantity, Quantity::emission);
  EXPECT_EQ(file_named("lamp_w.txt").quantity, Quantity::emission) << "by its remark";
  EXPECT_EQ(file_named("paper_refl.sp").quantity, Quantity::reflectance);
  EXPECT_EQ(file_named("km.csv").scale, Scale::percent);
  EXPECT_EQ(file_named("oceanview.txt").format, "OceanView's text");
  EXPECT_EQ(file_named("sekonic.csv").format, "Sekonic's export");
  EXPECT_EQ(file_named("sekonic.csv").quantity, Quantity::emission) << "it measures lamps alone";
}

TEST(Exports, OfNoisyLampsAreClampedOnRequestOnly) {
  const SpectrumFile file = file_named("pairs_neg.txt");
  const Spectrum& noisy = file.spectra.at(0).spectrum;
  EXPECT_FALSE(interpret(file, noisy, {}, Use::emission));
  const auto clamped = interpret(file, noisy, {.clamp = true}, Use::emission);
  ASSERT_TRUE(clamped);
  const auto below = std::count_if(noisy.values.begin(), noisy.values.end(),
                                   [](double value) { return value < 0; });
  EXPECT_EQ(clamped->notes,
            std::vector{std::to_string(below) + " of 1877 values were below 0 and are clamped"});
}

TEST(Exports, OfAPaperWithABrightenerStayAReflectance) {
  const SpectrumFile file = file_named("paper_refl.sp");
  const auto paper = interpret(file, file.spectra.at(0).spectrum, {}, Use::any);
  ASSERT_TRUE(paper);
  EXPECT_EQ(paper->quantity, Quantity::reflectance);
  const Spectrum& reflectance = paper->spectrum;
  const ObserverWeights weights =
      under_light(cie::observer_1931(), *cie::illuminant("D65"), reflectance.nm);
  const Xyz xyz = to_xyz(weights, reflectance.values);
  EXPECT_NEAR(xyz[0], 0.8671, 1e-3);
  EXPECT_NEAR(xyz[1], 0.9017, 1e-3);
  EXPECT_NEAR(xyz[2], 1.0436, 1e-3);
  EXPECT_FALSE(interpret(file, reflectance, {}, Use::property));
}

TEST(Exports, InMicrometresAreReadByAStatedUnitAlone) {
  EXPECT_FALSE(read_spectrum_file(export_named("Au_n_um.txt"), "Au_n_um.txt"));
  EXPECT_EQ(file_named("Au_n_um.txt", WavelengthUnit::um).spectra.at(0).spectrum,
            file_named("Au_n_nm.txt").spectra.at(0).spectrum);
}

TEST(Exports, ByCommaSemicolonAndFallingAreRead) {
  EXPECT_EQ(file_named("plain.csv").spectra.at(0).spectrum,
            (Spectrum{{380, 390, 400}, {0.1, 0.12, 0.2}}));
  EXPECT_EQ(file_named("km.csv").spectra.at(0).spectrum, (Spectrum{{360, 370}, {4.12, 4.5}}));
  EXPECT_EQ(file_named("sekonic.csv").spectra.at(0).spectrum, (Spectrum{{380, 381}, {3e-4, 4e-4}}));
  EXPECT_EQ(file_named("desc.txt").spectra.at(0).spectrum,
            (Spectrum{{710, 720, 730}, {0.58, 0.59, 0.6}}));
}

}  // namespace
}  // namespace metamer
