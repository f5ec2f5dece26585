// Contact sheets: what counts as a difference, and where maps and their legend are.

#include "client/tools/pictures/contact_sheet.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/color/srgb.h"
#include "common/image/ramp.h"

namespace metamer::client {
namespace {

Difference difference_of(std::vector<double> values) {
  Difference difference;
  difference.width = static_cast<int>(values.size());
  difference.height = 1;
  difference.values = std::move(values);
  difference.statistics = error_statistics(difference.values);
  return difference;
}

TEST(ContactSheet, RoundingIsNoDifference) {
  SheetCell cell;
  set_difference(difference_of({0, 1e-6, 0.004, 2, 4, 0, 0, 0}), cell);
  EXPECT_EQ(cell.difference->count, 2U);
  EXPECT_EQ(cell.difference->mean, 3);
  EXPECT_EQ(cell.share, 0.25);
}

/// Two candidates under one light; the second differs by 3 on its left half.
Sheet sheet(bool maps) {
  Sheet sheet{.lights = {"D65"}, .candidates = {"a", "b"}, .cells = {}, .maps = maps};
  Image black = make_image(360, 40, {"X", "Y", "Z"});
  std::vector<double> values(360 * 40);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = i % 360 < 180 ? 3 : 0;
  Difference difference{.width = 360, .height = 40, .values = values, .statistics = {}};
  for (const bool is_reference : {true, false}) {
    SheetCell& cell = sheet.cells.emplace_back();
    cell.picture = for_sheet(black);
    if (is_reference) continue;
    set_difference(difference, cell);
    cell.map = map_for_sheet(difference);
  }
  return sheet;
}

/// How many pixels have the false colour of a value.
int count(const Image& image, double value, double top) {
  Rgb linear{};
  const Rgb encoded = ramp_color(value, top);
  for (std::size_t c = 0; c < 3; ++c) linear[c] = srgb::decode(encoded[c]);
  const Xyz wanted = srgb::to_xyz(linear);
  int found = 0;
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    bool same = true;
    for (std::size_t c = 0; c < 3; ++c)
      same = same && image.pixels[i + c] == static_cast<float>(wanted[c]);
    found += same;
  }
  return found;
}

TEST(ContactSheet, MapsHaveOneScaleWhichTheLegendShows) {
  const auto without = contact_sheet(sheet(false)), with = contact_sheet(sheet(true));
  ASSERT_TRUE(without);
  ASSERT_TRUE(with);
  EXPECT_EQ(with->width, without->width);
  EXPECT_GT(with->height, without->height + 40);
  // 3 of 5: half of the map's pixels, and no more than a column of the legend.
  EXPECT_EQ(count(*without, 3, 5), 0);
  const int half = count(*with, 3, 5);
  EXPECT_GE(half, 180 * 40);
  EXPECT_LE(half, 180 * 40 + 40);
}

TEST(ContactSheet, MapsAreMeansOfWhatIsMadeSmaller) {
  Difference difference = difference_of(std::vector<double>(720));
  for (std::size_t i = 0; i < 720; i += 2) difference.values[i] = 4;
  difference.values[719] = std::numeric_limits<double>::quiet_NaN();
  const Image map = map_for_sheet(difference);
  ASSERT_EQ(map.width, 360);
  EXPECT_EQ(*map.at(0, 0), 2);
  EXPECT_TRUE(std::isnan(*map.at(359, 0))) << "what has no number keeps none";
}

TEST(Ramp, EndsAtOneTwoOrFive) {
  for (const auto& [value, end] : {std::pair(0.0, 1.0),
                                   {0.3, 0.5},
                                   {1.0, 1.0},
                                   {1.01, 2.0},
                                   {2.5, 5.0},
                                   {7.0, 10.0},
                                   {std::numeric_limits<double>::quiet_NaN(), 1.0}})
    EXPECT_DOUBLE_EQ(scale_end(value), end);
}

TEST(Ramp, GetsEverLighter) {
  double before = -1;
  for (int i = 0; i <= 100; ++i) {
    Rgb linear{};
    const Rgb encoded = cubehelix(i / 100.0);
    for (std::size_t c = 0; c < 3; ++c) linear[c] = srgb::decode(encoded[c]);
    const double y = srgb::to_xyz(linear)[1];
    EXPECT_GT(y, before) << i;
    before = y;
  }
  EXPECT_NEAR(before, 1, 1e-9);
}

TEST(PictureGrid, IsAboutAsWideAsHighAndTakesPicturesOfAnySize) {
  std::vector<SheetCell> cells(5);
  for (std::size_t i = 0; i < 4; ++i) {
    cells[i].picture = make_image(360, i == 3 ? 270 : 240, {"X", "Y", "Z"});
    cells[i].title = "a";
  }
  cells[4].title = "one that failed";
  const Result<Image> grid = picture_grid(cells);
  ASSERT_TRUE(grid) << grid.error().message;
  // Two columns of 360 and 12 around each; three rows of 270.
  EXPECT_EQ(grid->width, 12 + 2 * (360 + 12));
  EXPECT_GT(grid->height, 3 * 270);
  EXPECT_LT(grid->height, 3 * (270 + 2 * 20 + 12) + 40);
  EXPECT_FALSE(picture_grid({}));
  EXPECT_FALSE(picture_grid({cells[4]}));
}

}  // namespace
}  // namespace metamer::client
