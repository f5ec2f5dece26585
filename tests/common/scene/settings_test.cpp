#include "common/scene/settings.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include "scene_text.h"

namespace metamer::test {
namespace {

Strings settings(const std::string& text) {
  return findings({.settings = "settings { " + text + " }"});
}

Strings point(const std::string& text) { return settings("method { point { " + text + " } }"); }

TEST(Settings, DefaultsAreThoseOfTheSchema) {
  const v1::Settings full = with_defaults({});
  EXPECT_EQ(full.width(), 640u);
  EXPECT_EQ(full.height(), 480u);
  EXPECT_EQ(full.observer(), v1::CIE_1931_2DEG);
  EXPECT_EQ(full.spp(), 16u);
  EXPECT_EQ(full.depth(), 4u);
  EXPECT_EQ(full.threads(), 0u);
  EXPECT_EQ(full.tile_size(), 16u);
  EXPECT_TRUE(full.method().has_exact());

  v1::Settings by_points;
  by_points.mutable_method()->mutable_point();
  const auto wavelengths = point_wavelengths(with_defaults(by_points).method().point());
  ASSERT_TRUE(wavelengths);
  EXPECT_EQ(wavelengths->size(), 61u);
  EXPECT_EQ(wavelengths->nm().front(), 400);
  EXPECT_EQ(wavelengths->nm().back(), 700);
}

TEST(Settings, DefaultsReplaceNothingThatIsGiven) {
  v1::Settings given;
  given.set_depth(0);
  given.set_width(1);
  given.mutable_method()->mutable_rgb();
  const v1::Settings full = with_defaults(given);
  EXPECT_EQ(full.depth(), 0u);
  EXPECT_EQ(full.width(), 1u);
  EXPECT_TRUE(full.method().has_rgb());

  v1::Settings listed;
  listed.mutable_method()->mutable_point()->add_wavelengths(546);
  EXPECT_FALSE(with_defaults(listed).method().point().has_from());
}

TEST(Settings, AGoalWrittenTheOlderWayIsTheSame) {
  const auto filled = [](const std::string& text) {
    v1::Settings settings;
    EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &settings));
    return with_defaults(settings);
  };
  for (const auto& [goal, expected] : {std::pair{"", "tolerance: 0.5"},
                                       {"tolerance: 2", "tolerance: 2"},
                                       {"deadline: 3", "deadline: 3"}}) {
    const std::string text = " { " + std::string(goal) + " }";
    const v1::Settings now = filled("goal" + text);
    const v1::Settings before = filled("method { auto" + text + " }");
    EXPECT_EQ(now.goal().ShortDebugString(), expected);
    EXPECT_FALSE(now.has_method());
    EXPECT_EQ(before.ShortDebugString(), now.ShortDebugString());
    EXPECT_EQ(with_defaults(now).ShortDebugString(), now.ShortDebugString());
  }
}

TEST(Settings, TheOlderGoalHasItsBytes) {
  // 4: Settings.method, 6: Method.auto, 2: deadline; as clients send it that know no goal.
  v1::Settings settings;
  ASSERT_TRUE(
      settings.ParseFromString(std::string("\x22\x0b\x32\x09\x11\0\0\0\0\0\0\x08\x40", 13)));
  EXPECT_EQ(with_defaults(settings).goal().deadline(), 3);
}

TEST(Settings, OfAGoalMustBeAboveZeroAndStandAlone) {
  EXPECT_EQ(settings("goal {}"), Strings());
  EXPECT_EQ(settings("goal { deadline: 1 } method {}"), Strings());
  EXPECT_EQ(settings("goal { tolerance: 0 }"),
            Strings({"settings.goal.tolerance: tolerance must be above 0 (it is 0)"}));
  EXPECT_EQ(settings("method { auto { deadline: -1 } }"),
            Strings({"settings.method.auto.deadline: deadline must be above 0 (it is -1)"}));
  EXPECT_EQ(settings("goal { deadline: nan }"),
            Strings({"settings.goal.deadline: deadline must be finite (it is nan)"}));
  EXPECT_EQ(
      settings("goal {} method { exact {} }"),
      Strings({"settings.goal: settings take a method or a goal, not both: leave out exact and "
               "the server chooses, or leave out goal"}));
  EXPECT_EQ(settings("method { auto {} point { step: 5 } }"),
            Strings({"settings.method.auto: settings take a method or a goal, not both: leave out "
                     "point and the server chooses, or leave out method.auto",
                     "settings.method.point: point needs from, to and step together"}));
  EXPECT_EQ(settings("goal {} method { auto {} }"),
            Strings({"settings.method.auto: auto is the older way to write goal, which is given "
                     "too: leave it out"}));
}

TEST(Settings, BothObserversHaveTheirTable) {
  EXPECT_EQ(to_observer(v1::CIE_1931_2DEG), cie::observer_1931());
  EXPECT_EQ(to_observer(v1::CIE_1964_10DEG), cie::observer_1964());
}

TEST(Settings, AreOfSoManyRaysBetweenSurfaces) {
  EXPECT_EQ(settings("bounces: 17 bounce_samples: 257"),
            Strings({"settings.bounces: bounces must lie in 0..16 (it is 17)",
                     "settings.bounce_samples: bounce_samples must lie in 1..256 (it is 257)"}));
  EXPECT_EQ(settings("bounces: 16 spp: 64 bounce_samples: 256"), Strings());
  EXPECT_EQ(settings("bounces: 1 spp: 65 bounce_samples: 256"),
            Strings({"settings.bounce_samples: spp × bounce_samples must be at most 16384 (it is "
                     "16640)"}));
  EXPECT_EQ(settings("spp: 65 bounce_samples: 256"), Strings());
}

TEST(Settings, SizesOverTheLimits) {
  EXPECT_EQ(settings("width: 0 height: 16385"),
            Strings({"settings.width: width must lie in 1..16384 (it is 0)",
                     "settings.height: height must lie in 1..16384 (it is 16385)"}));
  EXPECT_EQ(settings("width: 16384 height: 16384"), Strings());
  EXPECT_EQ(settings("spp: 1025 depth: 65 threads: 257"),
            Strings({"settings.spp: spp must lie in 1..1024 (it is 1025)",
                     "settings.depth: depth must lie in 0..64 (it is 65)",
                     "settings.threads: threads must lie in 0..256 (it is 257)"}));
  for (const char* size : {"0", "12", "264"}) {
    EXPECT_EQ(settings(std::string("tile_size: ") + size),
              Strings({std::string("settings.tile_size: tile_size must be a multiple of 8 in "
                                   "8..256 (it is ") +
                       size + ")"}));
  }
}

TEST(Settings, PointTakesATripletOrAListNotBoth) {
  EXPECT_EQ(point("from: 400 to: 700 step: 5 wavelengths: 546"),
            Strings({"settings.method.point: point takes either from, to and step or wavelengths, "
                     "not both"}));
  EXPECT_EQ(point("step: 10"),
            Strings({"settings.method.point: point needs from, to and step together"}));
}

TEST(Settings, FittedWavelengthsStandAlone) {
  EXPECT_EQ(point("fitted: 1"), Strings());
  EXPECT_EQ(point("fitted: 64"), Strings());
  for (const char* other : {"step: 10", "wavelengths: 546", "from: 400 to: 700 step: 5"})
    EXPECT_EQ(point(std::string("fitted: 8 ") + other),
              Strings({"settings.method.point: fitted excludes from, to, step and wavelengths"}));
  EXPECT_EQ(point("fitted: 0"),
            Strings({"settings.method.point.fitted: fitted must lie in 1..64 (it is 0)"}));
  EXPECT_EQ(point("fitted: 65"),
            Strings({"settings.method.point.fitted: fitted must lie in 1..64 (it is 65)"}));
}

TEST(Settings, TripletsMustMakeSense) {
  EXPECT_EQ(point("from: 0 to: 700 step: 0"),
            Strings({"settings.method.point.from: from must lie in 1..10000 (it is 0)",
                     "settings.method.point.step: step must be above 0 (it is 0)"}));
  EXPECT_EQ(point("from: 700 to: 400 step: 5"),
            Strings({"settings.method.point.to: to must not be below from (400 is below 700)"}));
  const Strings many = point("from: 400 to: 700 step: 0.01");
  ASSERT_EQ(many.size(), 1u);
  EXPECT_NE(many[0].find("4001"), std::string::npos) << many[0];
  EXPECT_EQ(point("from: 400 to: 700 step: 1e-300").size(), 1u);
}

TEST(Settings, PrimariesMustSpanASpace) {
  const std::string srgb = "red: [0.64, 0.33] green: [0.3, 0.6] blue: [0.15, 0.06] ";
  const auto primaries = [&](const std::string& text) {
    return settings("development { adaptation: BRADFORD primaries { " + text + " } }");
  };
  const std::string field = "settings.development.primaries";
  EXPECT_EQ(settings("development { adaptation: SHARP rgb_space: PROPHOTO linear: true }"),
            Strings());
  EXPECT_EQ(primaries(srgb + "white: [0.3127, 0.329] gamma: 2.2"), Strings());
  EXPECT_EQ(primaries(srgb), Strings({field + ".white: white must be x and y (it has 0 numbers)"}));
  EXPECT_EQ(primaries(srgb + "white: [0.3127]"),
            Strings({field + ".white: white must be x and y (it has 1 number)"}));
  EXPECT_EQ(primaries(srgb + "white: [0.3127, 0.329] gamma: 0"),
            Strings({field + ": gamma must be above 0 (it is 0)"}));
  EXPECT_EQ(primaries(srgb + "white: [0.9, 0.1]"),
            Strings({field + ": white must lie inside the triangle of red, green and blue"}));
  EXPECT_EQ(primaries("red: [0, 0.1] green: [0, 0.2] blue: [0, 0.3] white: [0.3, 0.3]"),
            Strings({field + ": red, green and blue must not lie on a line"}));
  EXPECT_EQ(primaries(srgb + "white: [0.3127, nan]"),
            Strings({field + ".white[1]: white[1] must be finite (it is nan)"}));
}

TEST(Settings, ListedWavelengthsMustRise) {
  EXPECT_EQ(point("wavelengths: [400, 546, 436, 700]"),
            Strings({"settings.method.point.wavelengths[2]: wavelengths must rise (436 comes "
                     "after 546)"}));
  EXPECT_EQ(point("wavelengths: [400, 546, 546]"),
            Strings({"settings.method.point.wavelengths[2]: wavelengths must not repeat (546 is "
                     "there twice)"}));
  EXPECT_EQ(point("wavelengths: [-5, 546]"),
            Strings({"settings.method.point.wavelengths[0]: wavelengths must lie in 1..10000 nm "
                     "(it is -5)"}));
  std::string many = "wavelengths: [400";
  for (int i = 1; i <= 4001; ++i) many += ", " + std::to_string(400 + i);
  EXPECT_EQ(point(many + "]"),
            Strings({"settings.method.point.wavelengths[4001]: at most 4001 wavelengths can be "
                     "used (there are 4002)"}));
}

}  // namespace
}  // namespace metamer::test
