// Spectra at other wavelengths and of another luminance, against integrals done by hand.
#include "client/tools/spectra/spectra_change.h"

#include <gtest/gtest.h>

#include "common/color/xyz.h"

namespace metamer::client {
namespace {

ResampledSpectrum resampled_at(const Spectrum& spectrum, std::vector<double> nm,
                               bool emission = true) {
  return resampled(
      {"label", "name", emission ? Quantity::emission : Quantity::reflectance, spectrum},
      *Wavelengths::listed(std::move(nm)));
}

TEST(Resampled, AStraightLineLosesNothing) {
  const ResampledSpectrum made = resampled_at({{400, 700}, {0, 3}}, {400, 500, 600, 700});
  EXPECT_EQ(made.spectrum.name, "name");
  EXPECT_EQ(made.spectrum.spectrum.values, (std::vector<double>{0, 1, 2, 3}));
  EXPECT_DOUBLE_EQ(made.energy.before, 450);
  EXPECT_DOUBLE_EQ(made.energy.after, 450);
  EXPECT_EQ(made.without_data, 0u);
  EXPECT_FALSE(made.leaves_out);
  EXPECT_FALSE(made.changes);
}

TEST(Resampled, ALineBetweenTheSamplesIsMissed) {
  // 300 high and 2 nm wide at its foot: 300 nm of 600.
  const ResampledSpectrum made =
      resampled_at({{400, 546, 547, 548, 700}, {1, 1, 301, 1, 1}}, {400, 500, 600, 700});
  EXPECT_TRUE(made.changes);
  EXPECT_DOUBLE_EQ(made.energy.before, 600);
  EXPECT_DOUBLE_EQ(made.energy.after, 300);
  EXPECT_DOUBLE_EQ(made.energy.worst, -300);
  EXPECT_EQ(made.energy.worst_from, 500);
  EXPECT_EQ(made.energy.worst_to, 600);
}

TEST(Resampled, OnePercentOutsideIsTheLimit) {
  const Spectrum flat{{400, 500}, {1, 1}};
  EXPECT_FALSE(resampled_at(flat, {400, 499}).leaves_out);
  EXPECT_TRUE(resampled_at(flat, {400, 498.9}).leaves_out);
}

TEST(Resampled, WithoutDataALightIsDarkAndAPaintHolds) {
  const Spectrum flat{{450, 650}, {2, 2}};
  const std::vector<double> nm{400, 450, 550, 650, 700};
  const ResampledSpectrum light = resampled_at(flat, nm), paint = resampled_at(flat, nm, false);
  EXPECT_EQ(light.without_data, 2u);
  EXPECT_EQ(light.spectrum.spectrum.values, (std::vector<double>{0, 2, 2, 2, 0}));
  EXPECT_EQ(paint.spectrum.spectrum.values, (std::vector<double>{2, 2, 2, 2, 2}));
  EXPECT_FALSE(paint.changes);
}

TEST(Resampled, NothingIsSaidOfADarkOne) {
  const ResampledSpectrum made = resampled_at({{400, 700}, {0, 0}}, {500, 600});
  EXPECT_FALSE(made.leaves_out);
  EXPECT_FALSE(made.changes);
}

TEST(Normalized, HasTheLuminance) {
  for (const auto& observer : {cie::observer_1931(), cie::observer_1964()})
    for (const double luminance : {1e-30, 0.25, 1e30}) {
      const auto made =
          normalized({"", "", Quantity::emission, *cie::illuminant("F11")}, observer, luminance);
      ASSERT_TRUE(made);
      const Spectrum& light = made->spectrum.spectrum;
      const Xyz xyz = emission_xyz(light, observer);
      EXPECT_NEAR(xyz[1] / luminance, 1, 1e-14);
      EXPECT_DOUBLE_EQ(light.values[40] / cie::illuminant("F11")->values[40], made->factor);
    }
}

TEST(Normalized, RefusesWhatHasNoLuminance) {
  const auto refusal = [](const LoadedSpectrum& one, double luminance) {
    const auto made = normalized(one, cie::observer_1931(), luminance);
    return made ? "" : made.error().message;
  };
  EXPECT_EQ(refusal({"dark", "", Quantity::emission, {{400, 700}, {0, 0}}}, 1),
            "\"dark\" is dark to this observer");
  EXPECT_EQ(refusal({"heat", "", Quantity::emission, {{900, 1000}, {1, 1}}}, 1),
            "\"heat\" is dark to this observer");
  EXPECT_EQ(refusal({"paint", "", Quantity::reflectance, {{400, 700}, {1, 1}}}, 1),
            "\"paint\" is taken for a reflectance, which has no luminance of its own");
  // Seen at 555 nm, and enormous where nobody sees it.
  EXPECT_EQ(
      refusal({"vast", "", Quantity::emission, {{500, 600, 2000, 3000}, {1, 1, 1, 1e308}}}, 1e300),
      "\"vast\" overflows at that luminance");
}

}  // namespace
}  // namespace metamer::client
