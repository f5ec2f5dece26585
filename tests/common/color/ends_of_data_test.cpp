// What is said where data end, against closed forms of an observer and a light that are constant.
#include "common/color/ends_of_data.h"

#include <gtest/gtest.h>

#include "common/spectral/cie.h"

namespace metamer {
namespace {

const Spectrum box{{400, 700}, {1, 1}};

Observer boxes() { return *make_observer("boxes", {box, box, box}); }

TEST(EndsOfData, OfAPropertySayTheShareOfTheLightThatIsSeenBeyond) {
  const std::vector<CumulativeLight> light = {{"lamp", {{360, 830}, {5, 5}}, boxes()}};
  // 200 of 300 nm.
  EXPECT_EQ(ends_of_property({{500, 600}, {0.1, 0.2}}, light),
            "its data end at 500 and 600 nm: 67 % of what is seen of light \"lamp\" lies beyond, "
            "where it keeps its end values");
  EXPECT_NE(ends_of_property({{900, 950}, {0.1, 0.2}}, light).find(": 100 % of"),
            std::string::npos);
  EXPECT_NE(ends_of_property({{550}, {0.5}}, light).find(": 100 % of"), std::string::npos);
  EXPECT_EQ(ends_of_property({{401, 699}, {0.1, 0.2}}, light), "") << "2 of 300 nm";
  EXPECT_EQ(ends_of_property({{500, 600}, {0.1, 0.2}}, {}), "");
  EXPECT_EQ(ends_of_property({{500, 600}, {0.1, 0.2}}, {{"dark", {{400, 700}, {0, 0}}, boxes()}}),
            "");
}

TEST(EndsOfData, OfALightCountWhereItHasPower) {
  EXPECT_NE(
      ends_of_light({{450, 650}, {1, 1}}, cie::observer_1931()).find("where it still has power"),
      std::string::npos);
  EXPECT_EQ(ends_of_light({{450, 550, 650}, {0, 1, 0}}, cie::observer_1931()), "");
  EXPECT_EQ(ends_of_light({{550}, {1}}, cie::observer_1931()), "") << "a line";
  for (const std::string& name : cie::illuminant_names())
    EXPECT_EQ(ends_of_light(*cie::illuminant(name), cie::observer_1931()), "") << name;
}

TEST(EndsOfData, OfAnObserverCountWhereHeSees) {
  EXPECT_EQ(
      ends_of_observer(boxes()),
      "its data end at 400 and 700 nm, where it still sees 100 % of its most: nothing beyond");
  EXPECT_EQ(ends_of_observer(cie::observer_1931()), "");
  EXPECT_EQ(ends_of_observer(cie::observer_1964()), "");
}

}  // namespace
}  // namespace metamer
