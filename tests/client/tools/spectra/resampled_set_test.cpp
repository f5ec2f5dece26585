// Several spectra at the same wavelengths, as one text.
#include "client/tools/spectra/resampled_set.h"

#include <gtest/gtest.h>

#include "common/color/xyz.h"

namespace metamer::client {
namespace {

std::vector<LoadedSpectrum> loaded(const std::vector<std::string>& words) {
  auto all = load_spectra(words);
  EXPECT_TRUE(all);
  return *std::move(all);
}

TEST(ResampledSet, LightsComeFirstWhereAskedAndElseStay) {
  const auto spectra = loaded({"TCS01", "A", "TCS09", "F11"});
  ResampleChoice choice{.wavelengths = *Wavelengths::uniform(400, 700, 10)};
  const auto order = [&] {
    std::vector<std::size_t> originals;
    for (const ResampledRow& row : resampled_set(spectra, choice).rows)
      originals.push_back(row.original);
    return originals;
  };
  EXPECT_EQ(order(), (std::vector<std::size_t>{1, 3, 0, 2}));
  choice.lights_first = false;
  EXPECT_EQ(order(), (std::vector<std::size_t>{0, 1, 2, 3}));
}

TEST(ResampledSet, LightsHaveTheLuminanceThatIsWrittenAndPaintsAreLeftAlone) {
  const auto spectra = loaded({"F11", "TCS05"});
  const ResampleChoice choice{.wavelengths = *Wavelengths::uniform(400, 700, 20),
                              .luminance = 0.72,
                              .observer = cie::observer_1964()};
  const ResampledSet set = resampled_set(spectra, choice);
  EXPECT_NEAR(emission_xyz(set.rows[0].written, cie::observer_1964())[1], 0.72, 1e-12);
  EXPECT_EQ(set.rows[1].written, set.rows[1].made.spectrum.spectrum);
  EXPECT_EQ(set.rows[1].factor, 1);
  ASSERT_TRUE(set.text);
  const auto again = parse_spectra(*set.text, "text.sp");
  ASSERT_TRUE(again);
  EXPECT_EQ(again->front().spectrum, set.rows[0].written);
}

TEST(ResampledSet, ALightThatIsDarkAtTheNewWavelengthsIsAnError) {
  const auto spectra = loaded({"546nm"});
  const ResampleChoice choice{.wavelengths = *Wavelengths::listed({400, 500, 600}),
                              .luminance = 1,
                              .format = SpectrumFormat::pairs};
  const ResampledSet set = resampled_set(spectra, choice);
  EXPECT_EQ(set.rows.size(), 1u) << "what was lost is still told";
  EXPECT_GT(set.rows[0].made.energy.before, 0.9);
  EXPECT_FALSE(set.text);
}

TEST(ListedWavelengths, AreNumbersApartByBlanksCommasAndLines) {
  EXPECT_EQ(listed_wavelengths(" 400,436.5;\n546\t700 ")->nm(),
            (std::vector<double>{400, 436.5, 546, 700}));
  for (const char* wrong : {"", " ", "blue", "400 4x", "500 400", "400 400", "-1 5", "nan", "inf"})
    EXPECT_FALSE(listed_wavelengths(wrong)) << wrong;
  std::string many;
  for (std::size_t i = 0; i <= Wavelengths::max_count; ++i) many += std::to_string(300 + i) + " ";
  EXPECT_FALSE(listed_wavelengths(many));
}

}  // namespace
}  // namespace metamer::client
