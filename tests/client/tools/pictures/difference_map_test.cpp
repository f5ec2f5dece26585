// Differences as colours and as counts.
#include "client/tools/pictures/difference_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "common/image/ramp.h"

namespace metamer::client {
namespace {

Difference mapped_difference(std::vector<double> values) {
  Difference difference{
      .width = static_cast<int>(values.size()), .height = 1, .values = values, .statistics = {}};
  difference.statistics = error_statistics(difference.values);
  return difference;
}

TEST(DifferenceMap, HasTheRampsColours) {
  const Difference difference = mapped_difference({0, 0.5, 1, 1.7, 3, std::nan(""), INFINITY});
  const auto pixels = map_pixels(difference, 2);
  EXPECT_EQ(pixels[0], 0xff000000U);
  EXPECT_EQ(pixels[4], 0xffffffffU) << "above the top";
  EXPECT_EQ(pixels[5], 0xffff0000U) << "red has no number";
  EXPECT_EQ(pixels[6], 0xffff0000U);
  for (std::size_t i = 0; i < 4; ++i) {
    const Rgb exact = ramp_color(difference.values[i], 2);
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR((pixels[i] >> (16 - 8 * c)) & 0xff, 255 * exact[static_cast<std::size_t>(c)], 1);
  }
}

TEST(DifferenceHistogram, CountsEachFiniteDifferenceOnce) {
  const Difference difference =
      mapped_difference({0, 0.1, 0.25, 0.5, 0.99, 1, 7, std::nan(""), -INFINITY});
  const Histogram histogram = difference_histogram(difference, 4, 1);
  EXPECT_EQ(histogram.counts, (std::vector<std::size_t>{2, 1, 1, 1}));
  EXPECT_EQ(histogram.above, 2u);
  EXPECT_EQ(std::accumulate(histogram.counts.begin(), histogram.counts.end(), histogram.above),
            difference.statistics.count);
}

TEST(DifferenceHistogram, OverIsWhatIsAboveTheLimitOrHasNoNumber) {
  const Difference difference = mapped_difference({0, 1, 2, 2.5, std::nan("")});
  EXPECT_EQ(pixels_over(difference, 2), 2u);
  EXPECT_EQ(pixels_over(difference, 0), 4u);
  EXPECT_EQ(usual_top(difference), 5) << "99 % is 2.485";
}

}  // namespace
}  // namespace metamer::client
