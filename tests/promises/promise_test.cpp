// A chosen method keeps its promise on scenes that nobody tuned the choice on.

#include <gtest/gtest.h>

#include "tests/promises/measured_scene.h"

namespace metamer::promises {
namespace {

class Promise : public testing::TestWithParam<double> {};

TEST_P(Promise, IsKeptOnEveryPixelOfScenesNeverSeen) {
  for (const VariedScene& varied : varied_scenes(24, 96)) {
    MeasuredScene scene(varied);
    const PilotScene pilot = scene.pilot();
    const Choice choice = choose(pilot, tolerance(GetParam()), 0);
    EXPECT_EQ(choice.objection, "") << varied.about;
    ASSERT_NE(choice.prepared, nullptr);
    EXPECT_LE(measure(pilot, *choice.prepared).maximum(), GetParam()) << varied.about;
    EXPECT_LE(scene.render(choice.method).error.maximum(), GetParam())
        << varied.about << " by " << choice.method.ShortDebugString();
  }
}

INSTANTIATE_TEST_SUITE_P(Tolerances, Promise, testing::Values(0.1, 0.5, 1.0, 2.0));

MeasuredScene& a_scene() {
  static MeasuredScene scene(varied_scenes(1, 96).front());
  return scene;
}

TEST(Choice, SaysWhyWhenNoMethodIsThatAccurate) {
  const Choice choice = choose(a_scene().pilot(), tolerance(1e-9), 0);
  EXPECT_EQ(choice.objection.find("no method keeps to a tolerance of 1e-09"), 0u)
      << choice.objection;
  EXPECT_EQ(choice.predictions.size(), candidates().size());
}

TEST(Choice, SaysWhyWhenNoMethodIsThatQuickAndTakesTheCheapest) {
  v1::Goal goal;
  goal.set_deadline(1e-6);
  const Choice choice = choose(a_scene().pilot(), goal, 0);
  EXPECT_EQ(choice.objection.find("no method keeps to a deadline of 1e-06 s"), 0u)
      << choice.objection;
  // Or one that costs about as much.
  const auto seconds = [](const v1::Prediction& one) { return one.prepare() + one.render(); };
  int chosen = 0;
  for (const v1::Prediction& one : choice.predictions) {
    if (!one.chosen()) continue;
    ++chosen;
    EXPECT_LE(seconds(one), 1.06 * seconds(choice.predictions.front()));
  }
  EXPECT_EQ(chosen, 1);
}

TEST(Choice, WithTimeEnoughTakesAMethodWhoseErrorNobodySees) {
  v1::Goal goal;
  goal.set_deadline(1e6);
  const Choice choice = choose(a_scene().pilot(), goal, 0);
  EXPECT_EQ(choice.objection, "");
  EXPECT_LE(measure(a_scene().pilot(), *choice.prepared).maximum(), 0.05);
}

TEST(Choice, MeasuresWhatThePictureWillShow) {
  // Predicted, measured afresh, and over the whole picture: the naive way is off by about as much.
  v1::Method rgb;
  rgb.mutable_rgb();
  MeasuredScene scene(varied_scenes(1, 320).front());
  const PilotScene pilot = scene.pilot();
  Predictor predictor(pilot);
  const Predicted predicted = predictor.predict(rgb);
  const double whole = scene.render(rgb).error.mean();
  EXPECT_GT(whole, 0.1);
  EXPECT_NEAR(predicted.prediction.error().mean(), whole, 0.5 * whole);
  EXPECT_NEAR(measure(pilot, *predicted.method).mean(), whole, 0.5 * whole);
}

}  // namespace
}  // namespace metamer::promises
