#include "common/spectral/lines.h"

#include <gtest/gtest.h>

#include "common/color/xyz.h"

namespace metamer {
namespace {

const Observer& observer_of_1931 = cie::observer_1931();

/// x̄, ȳ, z̄ times the power of each line.
Xyz sum_over(const std::vector<Line>& lines) {
  Xyz xyz{};
  for (std::size_t c = 0; c < 3; ++c)
    for (const Line& line : lines)
      xyz[c] += line.power *
                resample(observer_of_1931.functions()[c], {line.nm}, Outside::zero).values[0];
  return xyz;
}

TEST(Lines, AreSeenAsTheirPowerTimesTheObserver) {
  // Mercury and sodium, the pair 0.6 nm apart, two lines at one place, and one that nobody sees.
  const std::vector<Line> lamp = {{1014, 50},  {546.1, 2},   {435.8, 1},   {404.7, 0.5},
                                  {589, 0.25}, {589.6, 0.5}, {435.8, 0.25}};
  const Xyz own = emission_xyz(with_lines({}, lamp), observer_of_1931), sum = sum_over(lamp);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(own[c], sum[c], 1e-5 * sum[c]);
}

TEST(Lines, AddToAContinuum) {
  const Spectrum continuum{{400, 500, 700}, {0.01, 0.02, 0.01}};
  for (const std::vector<Line>& lamp :
       {std::vector<Line>{{450, 1}, {600, 2}}, {{380, 1}}, {{720, 1}, {400, 1}}, {{700.0005, 3}}}) {
    const Xyz sum = sum_over(lamp), glow = emission_xyz(continuum, observer_of_1931);
    const Xyz own = emission_xyz(with_lines(continuum, lamp), observer_of_1931);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(own[c], glow[c] + sum[c], 2e-5 * (glow[c] + sum[c])) << lamp.front().nm;
  }
}

TEST(Lines, InsideAContinuumLeaveItsEnds) {
  // A light whose data end where it still shines is told of: its ends have to be those of its data.
  const Spectrum lamp = with_lines({{400, 700}, {1, 1}}, {{546.1, 1}});
  EXPECT_EQ(lamp.nm.front(), 400);
  EXPECT_EQ(lamp.nm.back(), 700);
  EXPECT_EQ(lamp.values.front(), 1);
  const Spectrum wider = with_lines({{400, 700}, {1, 1}}, {{365, 1}});
  EXPECT_EQ(resample(wider, {399.998, 400, 700}, Outside::zero).values,
            std::vector<double>({0, 1, 1}));
}

TEST(Lines, OfOneSampleAreEmissions) {
  EXPECT_EQ(as_emission({{500}, {3}}), with_lines({}, {{500, 3}}));
  const Spectrum two{{500, 501}, {3, 3}};
  EXPECT_EQ(as_emission(two), two);
}

}  // namespace
}  // namespace metamer
