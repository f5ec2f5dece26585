#include "common/spectral/interpolation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/spectral/cie.h"
#include "common/spectral/monotone_cubic.h"
#include "common/spectral/sprague.h"

namespace metamer {
namespace {

constexpr ValueRange property_values{0, 1}, emission_values{0, HUGE_VAL};
constexpr auto curves = {Interpolation::sprague, Interpolation::monotone_cubic};

const std::vector<double>& whole_nanometres() {
  static const std::vector<double> nm = observer_wavelengths().nm();
  return nm;
}

Spectrum wavy_paint(double from, double step, std::size_t count) {
  Spectrum samples;
  for (std::size_t i = 0; i < count; ++i) {
    samples.nm.push_back(from + static_cast<double>(i) * step);
    samples.values.push_back(0.5 + 0.4 * std::sin(samples.nm.back() / 30));
  }
  return samples;
}

double interpolated_at(const Spectrum& spectrum, double nm) {
  return resample(spectrum, {nm}, Outside::hold).values[0];
}

TEST(Interpolation, KeepsTheSamplesToTheBitAndAddsWholeNanometres) {
  for (const double from : {380.0, 350.5, 820.0})
    for (const double step : {10.0, 2.5, 20.0 / 3}) {
      const Spectrum samples = wavy_paint(from, step, 12);
      for (const Interpolation curve : curves) {
        const Spectrum fine =
            interpolated(samples, curve, property_values, whole_nanometres())->spectrum;
        for (std::size_t i = 0; i < samples.nm.size(); ++i)
          EXPECT_EQ(interpolated_at(fine, samples.nm[i]), samples.values[i]) << samples.nm[i];
        for (const double nm : fine.nm) {
          const bool sample =
              std::find(samples.nm.begin(), samples.nm.end(), nm) != samples.nm.end();
          EXPECT_TRUE(sample || (nm == std::round(nm) && nm >= 360 && nm <= 830)) << nm;
        }
        EXPECT_TRUE(make_spectrum(fine.nm, fine.values));
        for (double nm = 380; nm < 400; ++nm) {
          if (nm < samples.nm.front() || nm > samples.nm.back()) continue;
          const double exact = curve == Interpolation::sprague
                                   ? sprague(samples, {nm})->front()
                                   : monotone_cubic(samples, {nm})->front();
          EXPECT_NEAR(interpolated_at(fine, nm), exact, 1e-12) << nm;
        }
      }
      EXPECT_EQ(interpolated(samples, Interpolation::linear, property_values, whole_nanometres())
                    ->spectrum,
                samples);
    }
}

TEST(Interpolation, LeavesTheStraightLineWhereTheCurveLeavesTheRange) {
  // Sprague's curve overshoots on both sides of an edge: those stretches are as they were, all
  // others are curved.
  const Spectrum filter = {{400, 410, 420, 430, 440, 450, 460, 470, 480, 490, 500},
                           {0.2, 0.1, 0, 0, 0.1, 0.8, 1, 1, 0.9, 0.8, 0.5}};
  const Spectrum fine =
      interpolated(filter, Interpolation::sprague, property_values, whole_nanometres())->spectrum;
  EXPECT_LT(sprague(filter, {425})->front(), 0);
  EXPECT_GT(sprague(filter, {465})->front(), 1);
  for (const double value : fine.values) EXPECT_TRUE(value >= 0 && value <= 1) << value;
  for (const double nm : {425.0, 465.0})
    EXPECT_EQ(interpolated_at(fine, nm), interpolated_at(filter, nm)) << nm;
  for (const double nm : {405.0, 445.0, 485.0, 495.0})
    EXPECT_NEAR(interpolated_at(fine, nm), sprague(filter, {nm})->front(), 1e-12) << nm;

  EXPECT_EQ(
      interpolated(filter, Interpolation::sprague, property_values, whole_nanometres())->straight,
      3u);

  // A light may be above 1.
  const Spectrum light =
      interpolated(filter, Interpolation::sprague, emission_values, whole_nanometres())->spectrum;
  EXPECT_EQ(interpolated_at(light, 425), 0);
  EXPECT_GT(interpolated_at(light, 465), 1);
}

TEST(Interpolation, SurvivesValuesThatOverflow) {
  Spectrum samples = wavy_paint(400, 10, 12);
  for (std::size_t i = 0; i < 12; ++i) samples.values[i] = i % 2 == 0 ? 1e308 : 0;
  for (const Interpolation curve : curves) {
    const Spectrum fine =
        interpolated(samples, curve, emission_values, whole_nanometres())->spectrum;
    for (const double value : fine.values) EXPECT_TRUE(std::isfinite(value));
  }
  EXPECT_EQ(recommended_interpolation(samples, Outside::zero), Interpolation::linear);
}

TEST(Interpolation, OfPropertiesGoesByTheirSamples) {
  const auto of = [](const Spectrum& samples) {
    return recommended_interpolation(samples, Outside::hold);
  };
  EXPECT_EQ(of(wavy_paint(400, 10, 31)), Interpolation::sprague);
  EXPECT_EQ(of(wavy_paint(400, 2, 6)), Interpolation::sprague);
  EXPECT_EQ(of(wavy_paint(400, 10, 5)), Interpolation::linear);
  EXPECT_EQ(of(wavy_paint(400, 1, 301)), Interpolation::linear);
  EXPECT_EQ(of(wavy_paint(400, 0.1, 3001)), Interpolation::linear);
  EXPECT_EQ(of({{360, 830}, {1, 1}}), Interpolation::linear);
  EXPECT_EQ(of({{550}, {1}}), Interpolation::linear);

  Spectrum uneven = wavy_paint(400, 10, 31);
  uneven.nm[7] += 1;
  EXPECT_EQ(of(uneven), Interpolation::monotone_cubic);
  Spectrum fine = wavy_paint(400, 0.5, 301);
  fine.nm.back() += 100;
  EXPECT_EQ(of(fine), Interpolation::linear);
}

/// A Gaussian of full width `width` at half height.
struct LampPeak {
  double nm, width, height;
};

/// Of whatever is 0 where nobody measures.
double lamp_power(const std::vector<LampPeak>& peaks, double nm) {
  double sum = 0;
  for (const LampPeak& one : peaks)
    sum += one.height * std::exp(-4 * std::log(2.0) * std::pow((nm - one.nm) / one.width, 2));
  return sum;
}

/// What an instrument with a triangular slit as wide as its step measures.
template <class Power>
Spectrum through_slit(double from, double step, const Power& light) {
  Spectrum samples;
  for (double nm = from; nm <= 780; nm += step) {
    double sum = 0, weights = 0;
    for (double x = -step; x <= step; x += step / 200) {
      sum += (step - std::abs(x)) * light(nm + x);
      weights += step - std::abs(x);
    }
    samples.nm.push_back(nm);
    samples.values.push_back(sum / weights);
  }
  return samples;
}

/// That of uneven samples is judged by the cubic.
void shift_one_sample(Spectrum& samples) { samples.nm[20] += 0.5; }

TEST(Interpolation, OfSmoothLightIsCurved) {
  const std::vector<std::vector<LampPeak>> leds = {
      {{450, 22, 0.4}, {600, 130, 1}}, {{590, 40, 1}}, {{465, 45, 1}, {530, 60, 1}, {620, 50, 1}}};
  for (const double step : {5.0, 10.0}) {
    for (const std::vector<LampPeak>& led : leds) {
      Spectrum light = through_slit(380, step, [&](double nm) { return lamp_power(led, nm); });
      EXPECT_EQ(recommended_interpolation(light, Outside::zero), Interpolation::sprague) << step;
      shift_one_sample(light);
      EXPECT_EQ(recommended_interpolation(light, Outside::zero), Interpolation::monotone_cubic);
    }
  }
  // Narrower ones by 5 nm.
  for (const double width : {20.0, 25.0, 33.0}) {
    const std::vector<LampPeak> led = {{525, width, 1}, {600, 100, 0.2}};
    for (const double from : {380.0, 381.0, 382.0, 383.0, 384.0})
      EXPECT_EQ(
          recommended_interpolation(
              through_slit(from, 5, [&](double nm) { return lamp_power(led, nm); }), Outside::zero),
          Interpolation::sprague)
          << width;
  }
  for (const char* name : {"A", "B", "C", "D50", "D55", "D65", "D75", "D93", "E"})
    for (const double step : {5.0, 10.0, 20.0}) {
      const Spectrum& table = *cie::illuminant(name);
      const Spectrum light =
          through_slit(380, step, [&](double nm) { return interpolated_at(table, nm); });
      EXPECT_EQ(recommended_interpolation(light, Outside::zero), Interpolation::sprague)
          << name << " by " << step;
    }
}

TEST(Interpolation, OfLightWithLinesIsStraight) {
  for (int i = 1; i <= 12; ++i) {
    const Spectrum& table = *cie::illuminant("F" + std::to_string(i));
    EXPECT_EQ(recommended_interpolation(table, Outside::zero), Interpolation::linear) << i;
    Spectrum shifted = table;
    shift_one_sample(shifted);
    EXPECT_EQ(recommended_interpolation(shifted, Outside::zero), Interpolation::linear) << i;
    for (const double from : {380.0, 385.0}) {
      const Spectrum light =
          through_slit(from, 10, [&](double nm) { return interpolated_at(table, nm); });
      EXPECT_EQ(recommended_interpolation(light, Outside::zero), Interpolation::linear) << i;
    }
  }
  const std::vector<std::vector<LampPeak>> lamps = {
      {{450, 2, 1}, {532, 2, 1}, {638, 2, 1}},                       // lasers
      {{405, 1, 0.5}, {436, 1, 1}, {546, 1, 1.2}, {578, 2, 1}},      // mercury
      {{450, 20, 0.9}, {540, 90, 1}, {613, 5, 0.4}, {631, 5, 1.5}},  // an LED's fluoride phosphor
      {{498, 2, 0.3}, {568, 3, 0.5}, {589, 6, 1}, {600, 40, 0.6}},   // sodium, high pressure
  };
  for (const double step : {5.0, 10.0, 20.0})
    for (const std::vector<LampPeak>& lamp : lamps)
      for (const double phase : {0.0, 0.25, 0.5, 0.75}) {
        const Spectrum light =
            through_slit(380 + phase * step, step, [&](double nm) { return lamp_power(lamp, nm); });
        EXPECT_EQ(recommended_interpolation(light, Outside::zero), Interpolation::linear)
            << lamp.front().nm << " by " << step << " from " << light.nm.front();
      }
}

TEST(Interpolation, JudgesLightByWhatIsSeen) {
  // A line of mercury's in the infrared, 100 times as strong as a daylight with a line in green.
  Spectrum light;
  for (double nm = 380; nm <= 1100; nm += 5) {
    light.nm.push_back(nm);
    light.values.push_back(nm == 545 ? 2 : nm == 1015 ? 100 : 1);
  }
  EXPECT_EQ(recommended_interpolation(light, Outside::zero), Interpolation::linear);
  light.values[33] = 1;
  EXPECT_EQ(recommended_interpolation(light, Outside::zero), Interpolation::sprague);
}

TEST(Interpolation, IsRefusedWhereItCannotBe) {
  const auto refusal = [](const Spectrum& samples, Interpolation curve) {
    return interpolated(samples, curve, property_values, whole_nanometres()).error().message;
  };
  EXPECT_EQ(refusal(wavy_paint(400, 10, 5), Interpolation::sprague),
            "Sprague's interpolation takes 6 samples at least, not 5");
  EXPECT_EQ(refusal(wavy_paint(400, 10, 2), Interpolation::monotone_cubic),
            "a monotone cubic takes 3 samples at least, not 2");
}

TEST(Interpolation, HasWords) {
  for (const Interpolation one :
       {Interpolation::linear, Interpolation::sprague, Interpolation::monotone_cubic})
    EXPECT_EQ(find_interpolation(word_of(one)), one);
  EXPECT_EQ(word_of(Interpolation::monotone_cubic), "monotone-cubic");
  EXPECT_FALSE(find_interpolation("cubic"));
}

}  // namespace
}  // namespace metamer
