// Re-radiation, E[3.2-1], against integrals in closed form and the law of energy.
#include "common/spectral/fluorescence.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace metamer::test {
namespace {

/// Absorbs everything from 300 to 400 nm, and emits as much at each of 500 to 600 nm.
Fluorophore flat(double yield = 1) {
  return {Spectrum{{300, 400}, {1, 1}}, Spectrum{{500, 600}, {1, 1}}, yield};
}

TEST(Reradiation, CountsPhotons) {
  // ∫ μ dμ over 300 to 400 is 35,000; ∫ λ dλ over 500 to 600 is 55,000.
  const Spectrum out = reradiated(flat(), Spectrum{{200, 900}, {2, 2}});
  EXPECT_NEAR(resample(out, {550}, Outside::zero).values[0], 2 * 35'000.0 / 55'000, 1e-12);
  EXPECT_EQ(resample(out, {499, 601}, Outside::zero).values, (std::vector<double>{0, 0}));
  // Of light of 365 nm, 365/550 of the power comes out at a yield of 1, in the mean of the photons.
  EXPECT_NEAR(reradiated_shares(flat(0.5), {365})[0], 0.5 * 365 * 100 / 55'000, 1e-12);
}

TEST(Reradiation, OfALineIsThatOfItsPower) {
  const Spectrum line{{364.999, 365, 365.001}, {0, 1000, 0}};  // 1 in all
  for (const Spectrum& light : {line, Spectrum{{365}, {1}}}) {
    const Spectrum out = reradiated(flat(), light);
    EXPECT_NEAR(resample(out, {550}, Outside::zero).values[0], 365 / 55'000.0, 1e-9);
  }
}

TEST(Reradiation, NeverGoesToAShorterWavelength) {
  const Fluorophore wide{Spectrum{{400, 600}, {1, 1}}, Spectrum{{400, 600}, {1, 1}}, 1};
  const Spectrum out = reradiated(wide, Spectrum{{499.999, 500, 500.001}, {0, 1000, 0}});
  const auto at = [&](double nm) { return resample(out, {nm}, Outside::zero).values[0]; };
  EXPECT_EQ(at(499.9), 0);
  EXPECT_NEAR(at(500.1), 500.0 / 100'000, 1e-8);
  // Half of the photons that light of 500 nm excites would lie below it, 45 % as photons go.
  EXPECT_NEAR(reradiated_shares(wide, {500})[0], 500 * 100.0 / 100'000, 1e-12);
  // Of equal energy: ∫∫ μ λ over λ < μ by all of it is a half, as μ and λ are alike.
  EXPECT_NEAR(left_out_share(wide), 0.5, 1e-9);
  EXPECT_EQ(left_out_share(flat()), 0);
}

TEST(Reradiation, OfAMatrixIsLinearBetweenItsWavelengths) {
  // M(λ, μ) = (μ − 300)/100 · (600 − λ)/100 / 100 from 300 to 400 and 500 to 600 nm.
  const BispectralMatrix matrix{{300, 400}, {500, 600}, {0, 0, 0.01, 0}};
  // Of the power μ: ∫ (μ − 300)/100 μ dμ = 18,333.3.
  const Spectrum out = reradiated(matrix, Spectrum{{100, 900}, {100, 900}});
  EXPECT_NEAR(resample(out, {500}, Outside::zero).values[0], 0.01 * 55'000 / 3, 1e-9);
  EXPECT_NEAR(resample(out, {550}, Outside::zero).values[0], 0.005 * 55'000 / 3, 1e-9);
  EXPECT_NEAR(reradiated_shares(matrix, {350})[0], 0.5 * 0.01 * 50, 1e-12);
  EXPECT_EQ(reradiated_shares(matrix, {299, 401}), (std::vector<double>{0, 0}));
}

TEST(Reradiation, OfAMatrixsCellOnTheDiagonalGoesToNoShorterWavelength) {
  BispectralMatrix matrix{{400, 410, 420, 430}, {400, 410, 420, 430, 440}, {}};
  matrix.values.assign(20, 0.0);
  matrix.values[1 * 5 + 1] = 0.02;  // 410 nm at 410 nm: 0.02 · 10 of it in all
  const double at_412 = 0.8 * 0.2;  // of the line between 410 and 420
  const Spectrum out = reradiated(matrix, Spectrum{{411.999, 412, 412.001}, {0, 1000, 0}});
  const auto at = [&](double nm) { return resample(out, {nm}, Outside::zero).values[0]; };
  for (const double nm : {400.0, 405.0, 410.0, 411.0}) EXPECT_NEAR(at(nm), 0, 1e-15) << nm;
  // Below it lay 400 to 412; of its own side 412 to 420.
  EXPECT_NEAR(at(414), 0.8 * 0.02 * (0.6 + 1.0), 2e-6);
  EXPECT_NEAR(at(422), 0.8 * 0.02 * 0.2, 1e-5);
  EXPECT_NEAR(at(425), 0, 1e-15);
  double sum = 0;
  for (std::size_t i = 1; i < out.nm.size(); ++i)
    sum += (out.nm[i] - out.nm[i - 1]) * (out.values[i] + out.values[i - 1]) / 2;
  EXPECT_NEAR(sum, at_412, 0.02 * at_412);  // a step within a nanometre
  EXPECT_NEAR(reradiated_shares(matrix, {412})[0], at_412, 1e-12);

  // Under light of all wavelengths as much as the table's own sum.
  const Spectrum all = reradiated(matrix, Spectrum{{300, 900}, {1, 1}});
  double every = 0;
  for (std::size_t i = 1; i < all.nm.size(); ++i)
    every += (all.nm[i] - all.nm[i - 1]) * (all.values[i] + all.values[i - 1]) / 2;
  EXPECT_NEAR(every, 0.02 * 10 * 10, 1e-3);
  EXPECT_TRUE(std::is_sorted(all.nm.begin(), all.nm.end()));
}

TEST(Reradiation, IsExcitedFrom300To830) {
  const Fluorophore wide{Spectrum{{1, 10'000}, {1, 1}}, Spectrum{{840, 900}, {1, 1}}, 1};
  const double photons = (900.0 * 900 - 840 * 840) / 2, absorbed = (830.0 * 830 - 300 * 300) / 2;
  const Spectrum out = reradiated(wide, Spectrum{{1, 10'000}, {1, 1}});
  EXPECT_NEAR(resample(out, {870}, Outside::zero).values[0], absorbed / photons, 1e-9);
  EXPECT_EQ(excited_range(wide), (std::array{300.0, 830.0}));
  EXPECT_EQ(excited_range(Fluorophore{Spectrum{{250, 290}, {1, 1}}, wide.emission, 1}),
            std::nullopt);
  EXPECT_EQ(excited_range(flat(0)), std::nullopt);
}

TEST(Reradiation, SendsOutNoMoreThanComes) {
  EXPECT_EQ(energy_fault(flat(), Spectrum{{550}, {0.27}}),
            std::nullopt);  // 400 · 100 / 55,000 = 0.727
  EXPECT_EQ(energy_fault(flat(), Spectrum{{390, 400}, {0, 0.3}}),
            "more light comes out than in at 400 nm: 0.3 is reflected and 0.7273 "
            "re-radiated, in sum at most 1");
  // Where it absorbs nothing, all may be reflected.
  EXPECT_EQ(energy_fault(flat(), Spectrum{{400, 401}, {0.2, 1}}), std::nullopt);
}

}  // namespace
}  // namespace metamer::test
