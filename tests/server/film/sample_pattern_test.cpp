#include "server/film/sample_pattern.h"

#include <gtest/gtest.h>

#include <set>

namespace metamer {
namespace {

TEST(SamplePattern, OneSampleIsThePixelsMiddle) {
  const auto one = sample_pattern(1);
  EXPECT_EQ(one[0].x, 0.5f);
  EXPECT_EQ(one[0].y, 0.5f);
}

TEST(SamplePattern, HasOneSampleInEachColumnAndInEachElementaryInterval) {
  for (unsigned count : {1u, 2u, 4u, 16u, 64u, 1024u})
    for (unsigned columns = 1; columns <= count; columns *= 2) {
      std::set<std::pair<unsigned, unsigned>> cells;
      const unsigned rows = count / columns;
      for (const SamplePoint& p : sample_pattern(count))
        cells.emplace(static_cast<unsigned>(p.x * static_cast<float>(columns)),
                      static_cast<unsigned>(p.y * static_cast<float>(rows)));
      EXPECT_EQ(cells.size(), count) << columns << " columns";
    }
}

TEST(SamplePattern, LiesInsideThePixelForEveryCount) {
  for (unsigned count = 1; count <= 1024; ++count)
    for (const SamplePoint& p : sample_pattern(count)) {
      ASSERT_GT(p.x, 0);
      ASSERT_LT(p.x, 1);
      ASSERT_GT(p.y, 0);
      ASSERT_LT(p.y, 1);
    }
}

}  // namespace
}  // namespace metamer
