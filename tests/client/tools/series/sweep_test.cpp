// All combinations of some values, and what becomes of each.
#include "client/tools/series/sweep.h"

#include <gtest/gtest.h>

#include <cmath>

namespace metamer::client {
namespace {

TEST(Sweep, AxesAreNamesAndValues) {
  const auto axis = parse_axis("--method=exact,rgb");
  ASSERT_TRUE(axis);
  EXPECT_EQ(axis->name, "method");
  EXPECT_EQ(axis->values, (std::vector<std::string>{"exact", "rgb"}));
  EXPECT_EQ(parse_axis("wavelengths=400,500;450,550")->values,
            (std::vector<std::string>{"400,500", "450,550"}));
  EXPECT_EQ(parse_axis("light=key=A,key=D65")->values,
            (std::vector<std::string>{"key=A", "key=D65"}));
  for (const char* wrong : {"", "method", "=a", "method=", "method=a,,b", "method=a,a"})
    EXPECT_FALSE(parse_axis(wrong)) << wrong;
}

TEST(Sweep, RowsAreAllCombinationsTheLastAxisFastest) {
  const std::vector<SweepAxis> axes = {{"a", {"1", "2"}}, {"b", {"x", "y", "z"}}};
  const auto rows = sweep_rows(axes);
  ASSERT_TRUE(rows);
  ASSERT_EQ(rows->size(), 6u);
  EXPECT_EQ((*rows)[0].label, "a=1 b=x");
  EXPECT_EQ((*rows)[1].label, "a=1 b=y");
  EXPECT_EQ((*rows)[5].label, "a=2 b=z");
  EXPECT_EQ((*rows)[3].values, (std::vector<std::string>{"2", "x"}));
  // Too many to be counted, too.
  const SweepAxis thousand{"n", std::vector<std::string>(1000, "v")};
  EXPECT_TRUE(sweep_rows({thousand, {"b", std::vector<std::string>(100, "v")}}));
  EXPECT_FALSE(sweep_rows({thousand, {"b", std::vector<std::string>(101, "v")}}));
  EXPECT_FALSE(sweep_rows(std::vector<SweepAxis>(64, thousand)));
}

TEST(Sweep, ARowIsNamedByItsNumberOrByValuesThatNoOtherHas) {
  const std::vector<SweepAxis> axes = {{"a", {"1", "2"}}, {"b", {"x", "y"}}};
  const auto rows = sweep_rows(axes).value();
  EXPECT_EQ(find_row(axes, rows, "3").value(), 2u);
  EXPECT_EQ(find_row(axes, rows, "a=2 b=y").value(), 3u);
  EXPECT_EQ(find_row(axes, rows, "b=y a=1").value(), 1u);
  EXPECT_EQ(find_row({axes[0]}, sweep_rows({axes[0]}).value(), "a=2").value(), 1u);
  for (const char* wrong : {"0", "5", "a=2", "a=3", "", "x"})
    EXPECT_FALSE(find_row(axes, rows, wrong)) << wrong;
}

Image grey(float y, int width = 2) {
  Image image = make_image(width, 1, {"X", "Y", "Z"});
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    image.pixels[i] = 0.95047F * y;
    image.pixels[i + 1] = y;
    image.pixels[i + 2] = 1.08883F * y;
  }
  return image;
}

v1::Plan with_white() {
  v1::Plan plan;
  for (const double value : {0.95047, 1.0, 1.08883}) plan.add_source_white(value);
  return plan;
}

/// A scene whose one light has a luminance of 1.
v1::Scene lit_scene() {
  v1::Scene scene;
  scene.add_light()->set_luminance(1);
  return scene;
}

TEST(Sweep, RowsAreComparedWheneverTheReferenceComes) {
  std::vector<SweepOutcome> outcomes(4);
  SweepComparison comparison;
  comparison.add(outcomes[0], grey(0.5F));
  EXPECT_FALSE(outcomes[0].error);
  comparison.set_reference(grey(0.5F), with_white(), lit_scene());
  comparison.add(outcomes[1], grey(0.25F));
  comparison.add(outcomes[2], grey(0.5F, 3));
  ASSERT_TRUE(outcomes[0].error);
  EXPECT_EQ(outcomes[0].error->maximum, 0);
  // Greys of L* 76.069 and 57.075 (CIE 15); ΔE00 = ΔL / S_L, S_L of their mean (CIE 142).
  const double lighter = 116 * std::cbrt(0.5) - 16, darker = 116 * std::cbrt(0.25) - 16;
  const double square = std::pow((lighter + darker) / 2 - 50, 2);
  const double expected = (lighter - darker) / (1 + 0.015 * square / std::sqrt(20 + square));
  ASSERT_TRUE(outcomes[1].error);
  EXPECT_NEAR(outcomes[1].error->mean, expected, 0.01);
  EXPECT_FALSE(outcomes[2].error);
  EXPECT_FALSE(outcomes[2].uncompared.empty()) << "another size";
  ASSERT_TRUE(outcomes[1].white);
  EXPECT_EQ(outcomes[1].white->name, "of the dominant light");
  EXPECT_EQ(outcomes[1].white->xyz, (Xyz{0.95047, 1, 1.08883}));
  EXPECT_TRUE(outcomes[1].not_in_error.empty());
}

TEST(Sweep, HowAPictureIsShownIsNamedWhereTheDifferenceKnowsNothingOfIt) {
  SweepOutcome outcome;
  outcome.development.set_exposure(2);
  outcome.development.set_rgb_space(v1::REC_2020);
  outcome.development.set_adaptation(v1::BRADFORD);
  SweepComparison comparison;
  comparison.add(outcome, grey(0.5F));
  v1::Plan plan = with_white();
  plan.mutable_development()->set_adaptation(v1::BRADFORD);
  plan.mutable_development()->set_linear(true);
  comparison.set_reference(grey(0.5F), plan, lit_scene());
  EXPECT_EQ(outcome.not_in_error, (std::vector<std::string>{"rgb", "exposure", "linear"}));
}

TEST(Sweep, WithoutItsReferenceSaysWhyNothingIsCompared) {
  std::vector<SweepOutcome> outcomes(2);
  SweepComparison comparison;
  comparison.add(outcomes[0], grey(0.5F));
  comparison.give_up("it failed");
  comparison.add(outcomes[1], grey(0.5F));
  for (const SweepOutcome& one : outcomes) EXPECT_EQ(one.uncompared, "it failed");
}

TEST(Sweep, TheTableHasEachRowInOneLine) {
  std::vector<SweepOutcome> outcomes(3);
  const std::vector<SweepAxis> axes = {{"light", {"a=A,b", "c\"d", "e"}}};
  EXPECT_EQ(outcomes[0].failure, "not finished");
  for (std::size_t i = 0; i < 3; ++i) {
    outcomes[i].row = sweep_rows(axes).value()[i];
    outcomes[i].failure.clear();
  }
  outcomes[0].is_reference = true;
  outcomes[0].timing.set_render(0.25);
  outcomes[0].timing.set_rays(1000);
  outcomes[0].record.add_machine()->set_name("n1");
  outcomes[0].record.add_phase()->set_cpu_seconds(0.5);
  outcomes[0].record.add_phase()->set_cpu_seconds(0.125);
  outcomes[1].failure = "no such luck";
  outcomes[2].uncompared = "another size";
  outcomes[2].accuracy.emplace().mutable_error()->set_mean(0.5);
  outcomes[2].job = {.number = 7, .server = "3f9c2a1b"};
  EXPECT_EQ(
      sweep_csv(axes, outcomes),
      "light,render_seconds,prepare_seconds,total_seconds,cpu_seconds,rays,mean,median,"
      "percentile_95,percentile_99,maximum,x,y,not_finite,white_x,white_y,white_z,not_in_error,"
      "verified_mean,verified_percentile_95,verified_maximum,kept,reference,machines,job,"
      "failure\r\n"
      "\"a=A,b\",0.25,0,0,0.625,1000,,,,,,,,,,,,,,,,,1,n1,,\r\n"
      "\"c\"\"d\",,,,,,,,,,,,,,,,,,,,,,0,,,no such luck\r\n"
      "e,0,0,0,0,0,,,,,,,,,,,,,0.5,0,0,0,0,,7@3f9c2a1b,another size\r\n");
}

}  // namespace
}  // namespace metamer::client
