// Lamps of every kind, from data by 0.02 to 20 nm, even and uneven, against sums over 0.005 nm that
// lamps.py beside this file makes with numpy.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "common/color/rendering_index.h"
#include "common/color/xyz.h"

namespace metamer {
namespace {

struct Component {
  double nm, width, height;  ///< Full width at half height.
};

struct Lamp {
  const char* name;
  std::vector<Component> components;
  std::vector<double> nm;
};

std::vector<double> even(double from, double to, double step) {
  std::vector<double> nm;
  for (int i = 0; i <= std::lround((to - from) / step); ++i) nm.push_back(from + i * step);
  return nm;
}

std::vector<double> uneven() {
  std::vector<double> nm;
  for (int i = 0; i <= 60; ++i) nm.push_back(380 + 400 * std::pow(i / 60.0, 1.5));
  return nm;
}

Spectrum emission_of(const Lamp& lamp) {
  Spectrum light{lamp.nm, {}};
  for (const double nm : lamp.nm) {
    double sum = 0;
    for (const Component& one : lamp.components)
      sum += one.height * std::exp(-4 * std::log(2.0) * std::pow((nm - one.nm) / one.width, 2));
    light.values.push_back(sum);
  }
  return light;
}

const std::vector<Lamp>& lamps() {
  static const std::vector<Lamp> all = {
      {"led", {{450, 20, 1}, {550, 120, 0.6}}, even(380, 780, 5)},
      {"laser phosphor", {{445.5, 0.3, 100}, {560, 110, 1}}, even(380, 780, 0.1)},
      {"mercury",
       {{404.66, 0.3, 0.4},
        {435.83, 0.3, 1},
        {546.07, 0.3, 1},
        {576.96, 0.3, 0.3},
        {579.07, 0.3, 0.3},
        {520, 300, 0.01}},
       even(380, 780, 0.05)},
      {"sodium", {{589, 0.1, 1}, {589.6, 0.1, 0.5}}, even(585, 595, 0.05)},
      {"hid",
       {{420.2, 0.4, 1}, {535.1, 0.4, 2}, {589.3, 6, 0.8}, {671, 0.4, 0.5}, {550, 250, 0.05}},
       even(380, 780, 0.2)},
      {"lasers", {{457, 0.1, 1}, {532, 0.1, 1}, {638, 0.1, 1.2}}, even(450, 645, 0.02)},
      {"20 nm", {{600, 200, 1}}, even(380, 780, 20)},
      {"uneven", {{450, 20, 1}, {550, 120, 0.6}}, uneven()}};
  return all;
}

struct Truth {
  const char* name;
  Xyz two, ten;  ///< The light to both observers.
  Xyz tcs09;     ///< To the observer of 1931, of a white of Y = 1.
  double ra;
};

const std::vector<Truth>& truths() {
  static const std::vector<Truth> all = {{"led",
                                          {42.02607, 49.887227, 49.950363},
                                          {46.988469, 53.719348, 53.461385},
                                          {0.11667532, 0.078086124, 0.040283938},
                                          65.80},
                                         {"laser phosphor",
                                          {71.854623, 80.576924, 69.494349},
                                          {80.313783, 85.389082, 76.553611},
                                          {0.1312757, 0.084773788, 0.036255788},
                                          60.83},
                                         {"mercury",
                                          {1.2771167, 1.4610912, 1.4668248},
                                          {1.4279972, 1.5625614, 1.6058994},
                                          {0.13531556, 0.083726498, 0.042536743},
                                          63.71},
                                         {"sodium",
                                          {0.16280758, 0.12242225, 0.00018144737},
                                          {0.17772616, 0.12544729, 0},
                                          {0.13012065, 0.097833227, 0.00014498741},
                                          -46.86},
                                         {"hid",
                                          {9.9239274, 9.6479491, 3.8389402},
                                          {10.924609, 10.153292, 4.1877103},
                                          {0.15566297, 0.099426065, 0.015866246},
                                          51.49},
                                         {"lasers",
                                          {0.11493515, 0.12421568, 0.18711374},
                                          {0.12311622, 0.13280229, 0.1991266},
                                          {0.36616183, 0.16425607, 0.059722399},
                                          33.32},
                                         {"20 nm",
                                          {86.338941, 87.389066, 26.363927},
                                          {93.414732, 91.974015, 26.941072},
                                          {0.25714239, 0.13663669, 0.011268854},
                                          85.77},
                                         {"uneven",
                                          {42.010893, 49.861486, 49.925753},
                                          {46.96757, 53.695791, 53.424777},
                                          {0.11683887, 0.078153022, 0.040270387},
                                          65.88}};
  return all;
}

class Lamps : public testing::TestWithParam<std::size_t> {
 protected:
  const Spectrum light_ = emission_of(lamps()[GetParam()]);
  const Truth& truth_ = truths()[GetParam()];
};

void expect_alike(const Xyz& own, const Xyz& truth) {
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(own[c], truth[c], 1e-5 * truth[c]) << c;
}

TEST_P(Lamps, HaveTheXyzOfTheirIntegrals) {
  expect_alike(emission_xyz(light_, cie::observer_1931()), truth_.two);
  expect_alike(emission_xyz(light_, cie::observer_1964()), truth_.ten);
}

TEST_P(Lamps, ShowAPaintAsItsIntegral) {
  const Spectrum& paint = *cie::test_color("TCS09");
  const ObserverWeights lit = under_light(cie::observer_1931(), light_, paint.nm);
  expect_alike(to_xyz(lit, paint.values), truth_.tcs09);
}

TEST_P(Lamps, RenderColoursAsTheirIntegrals) {
  const auto index = rendering_index(light_);
  ASSERT_TRUE(index);
  // Sums over tables by 5 nm are the CIE's way, to which a light of these samples is kept.
  const bool summed = std::fmod(light_.nm[1], 5) == 0;
  EXPECT_NEAR(index->ra, truth_.ra, summed ? 0.3 : 0.006);
}

INSTANTIATE_TEST_SUITE_P(OfEveryKind, Lamps, testing::Range<std::size_t>(0, 8),
                         [](const auto& tested) {
                           std::string name = lamps()[tested.param].name;
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

}  // namespace
}  // namespace metamer
