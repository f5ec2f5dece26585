#include "common/color/xyz.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace metamer {
namespace {

struct White {
  const char* light;
  double x, y;
};

struct WhitePoint {
  double x, y;
};

WhitePoint chromaticity(const Xyz& xyz) {
  const double sum = xyz[0] + xyz[1] + xyz[2];
  return {xyz[0] / sum, xyz[1] / sum};
}

Xyz white_of(Observer observer, const std::string& light) {
  // The CIE's own tables of white points sum from 380 to 780 nm by 5 nm.
  const Wavelengths wavelengths = *Wavelengths::uniform(380, 780, 5);
  const Spectrum& spectrum = *cie::illuminant(light);
  return to_xyz(observer_weights(observer, wavelengths),
                resample(spectrum, wavelengths.nm(), Outside::zero).values);
}

void expect_white(Observer observer, const White& white, double tolerance) {
  const WhitePoint c = chromaticity(white_of(observer, white.light));
  EXPECT_NEAR(c.x, white.x, tolerance) << white.light;
  EXPECT_NEAR(c.y, white.y, tolerance) << white.light;
}

TEST(WhitePoints, AreThePublishedOnesFor2Degrees) {
  // CIE 15, table T.3: five digits, of tables with finer steps than ours.
  for (const White& white : std::vector<White>{{"A", 0.44757, 0.40745},
                                               {"B", 0.34842, 0.35161},
                                               {"C", 0.31006, 0.31616},
                                               {"D50", 0.34567, 0.35850},
                                               {"D55", 0.33242, 0.34743},
                                               {"D65", 0.31272, 0.32903},
                                               {"E", 0.33333, 0.33333}}) {
    expect_white(cie::observer_1931(), white, 5e-5);
  }
}

TEST(WhitePoints, OfFluorescentLampsAreThePublishedOnes) {
  // CIE 15, table T.8: four digits.
  for (const White& white : std::vector<White>{{"F1", 0.3131, 0.3371},
                                               {"F2", 0.3721, 0.3751},
                                               {"F3", 0.4091, 0.3941},
                                               {"F4", 0.4402, 0.4031},
                                               {"F5", 0.3138, 0.3452},
                                               {"F6", 0.3779, 0.3882},
                                               {"F7", 0.3129, 0.3292},
                                               {"F8", 0.3458, 0.3586},
                                               {"F9", 0.3741, 0.3727},
                                               {"F10", 0.3458, 0.3588},
                                               {"F11", 0.3805, 0.3769},
                                               {"F12", 0.4370, 0.4042}}) {
    expect_white(cie::observer_1931(), white, 8e-5);
  }
}

TEST(WhitePoints, AreThePublishedOnesFor10Degrees) {
  for (const White& white : std::vector<White>{{"A", 0.45117, 0.40594},
                                               {"C", 0.31039, 0.31905},
                                               {"D50", 0.34773, 0.35952},
                                               {"D55", 0.33411, 0.34877},
                                               {"D65", 0.31382, 0.33100},
                                               {"E", 0.33333, 0.33333}}) {
    expect_white(cie::observer_1964(), white, 5e-5);
  }
  // These were summed by 1 nm.
  for (const White& white : std::vector<White>{
           {"F2", 0.37925, 0.36733}, {"F7", 0.31569, 0.32960}, {"F11", 0.38541, 0.37123}}) {
    const WhitePoint c =
        chromaticity(emission_xyz(*cie::illuminant(white.light), cie::observer_1964()));
    EXPECT_NEAR(c.x, white.x, 2e-5) << white.light;
    EXPECT_NEAR(c.y, white.y, 2e-5) << white.light;
  }
}

/// A table with even steps, looked up without the code under test.
double between(const Spectrum& table, double nm) {
  const double place = (nm - table.nm.front()) / (table.nm[1] - table.nm[0]);
  const auto left = static_cast<std::size_t>(std::floor(place));
  if (left + 1 == table.nm.size()) return table.values[left];
  const double t = place - std::floor(place);
  return table.values[left] + t * (table.values[left + 1] - table.values[left]);
}

TEST(Xyz, OfTheTestColoursEqualsPlainSums) {
  const Wavelengths wavelengths = *Wavelengths::uniform(400, 700, 1);
  const Spectrum& light = *cie::illuminant("D65");
  for (const Observer& observer : {cie::observer_1931(), cie::observer_1964()}) {
    const ObserverWeights weights = observer_weights(observer, wavelengths);
    const auto& functions = observer.functions();
    for (const std::string& name : cie::test_color_names()) {
      const Spectrum& paint = *cie::test_color(name);

      // E[3.2-2] by a loop over nanometres.
      Xyz expected{};
      for (int nm = 400; nm <= 700; ++nm) {
        const double power = between(light, nm) * between(paint, nm);
        for (std::size_t c = 0; c < 3; ++c) expected[c] += between(functions[c], nm) * power;
      }

      std::vector<double> power = resample(light, wavelengths.nm(), Outside::zero).values;
      const auto reflected = resample(paint, wavelengths.nm(), Outside::hold).values;
      for (std::size_t i = 0; i < power.size(); ++i) power[i] *= reflected[i];
      const Xyz xyz = to_xyz(weights, power);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(xyz[c], expected[c], 1e-12 * expected[c]) << name << " " << c;
      }
    }
  }
}

TEST(Xyz, TakesEachSampleWithItsOwnCell) {
  // Positions on nodes of the tables, 10 to 60 nm apart; widths by Fig. 4-2.
  const Wavelengths wavelengths = *Wavelengths::listed({450, 460, 490, 550});
  const double widths[] = {10, 20, 45, 60};
  const auto& functions = cie::observer_1931().functions();
  const ObserverWeights weights = observer_weights(cie::observer_1931(), wavelengths);
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < 4; ++i) {
      EXPECT_EQ(weights.weights[c][i], between(functions[c], wavelengths.nm()[i]) * widths[i]);
    }
  }
}

TEST(Xyz, IsBlackOutsideTheObserver) {
  const Wavelengths wavelengths = *Wavelengths::listed({200, 359, 831, 1000});
  const ObserverWeights weights = observer_weights(cie::observer_1931(), wavelengths);
  EXPECT_EQ(to_xyz(weights, {1, 1, 1, 1}), (Xyz{0, 0, 0}));
}

TEST(Luminance, IsExactlyTheOneAskedFor) {
  const Wavelengths wavelengths = *Wavelengths::uniform(400, 700, 5);
  for (const Observer& observer : {cie::observer_1931(), cie::observer_1964()}) {
    const ObserverWeights weights = observer_weights(observer, wavelengths);
    for (const std::string& name : cie::illuminant_names()) {
      for (const double luminance : {1.0, 0.25, 100.0}) {
        std::vector<double> power =
            resample(*cie::illuminant(name), wavelengths.nm(), Outside::zero).values;
        const double scale = luminance_scale(weights, power, luminance);
        for (double& value : power) value *= scale;
        EXPECT_NEAR(to_xyz(weights, power)[1], luminance, 1e-14 * luminance) << name;
      }
    }
  }
}

TEST(Luminance, OfALightThatNobodySeesHasTheScale0) {
  const ObserverWeights weights =
      observer_weights(cie::observer_1931(), *Wavelengths::listed({400, 900}));
  EXPECT_EQ(luminance_scale(weights, {0, 0}, 1), 0);
  EXPECT_EQ(luminance_scale(weights, {0, 5}, 1), 0) << "infrared";
  EXPECT_EQ(luminance_scale(weights, {std::numeric_limits<double>::denorm_min(), 0}, 1), 0)
      << "a scale that overflows";
  EXPECT_EQ(luminance_scale(weights, {1, 0}, 0), 0);
}

}  // namespace
}  // namespace metamer
