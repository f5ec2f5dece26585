// A chosen method keeps its promise on scenes that nobody tuned the choice on; promise_report has
// more of them.

#include <gtest/gtest.h>

#include "tests/promises/measured_scene.h"

namespace metamer::promises {
namespace {

void expect_kept(const std::vector<VariedScene>& scenes) {
  for (const VariedScene& varied : scenes) {
    MeasuredScene scene(varied);
    const PilotScene pilot = scene.pilot();
    for (const double promise : {0.1, 0.5, 1.0, 2.0}) {
      const Choice choice = choose(pilot, tolerance(promise), 0);
      EXPECT_EQ(choice.objection, "") << varied.about;
      ASSERT_NE(choice.prepared, nullptr);
      const v1::ColorError measured = measure(pilot, *choice.prepared).error();
      EXPECT_LE(measured.maximum(), promise) << varied.about;
      const v1::ColorError whole = scene.render(choice.method).error;
      EXPECT_LE(whole.maximum(), promise)
          << varied.about << " by " << choice.method.ShortDebugString();
      EXPECT_LE(measured.maximum(), whole.maximum() + 1e-3) << "pixels of another picture";
    }
  }
}

TEST(Promise, IsKeptOnEveryPixelOfScenesNeverSeen) { expect_kept(varied_scenes(8, 96)); }
TEST(Promise, IsKeptOnEveryPixelUnderNarrowLines) { expect_kept(narrow_scenes(6, 96)); }

/// Or the promises above would be kept by a truth that is no other than the method's own.
TEST(Promise, IsBrokenUnderNarrowLinesByWhoSamplesThem) {
  v1::Method sampled;
  sampled.mutable_point()->set_from(360);
  sampled.mutable_point()->set_to(830);
  sampled.mutable_point()->set_step(1);
  sampled.mutable_point()->set_lights(v1::Point::SAMPLES);
  int broken = 0;
  for (const VariedScene& varied : narrow_scenes(6, 48))
    broken += MeasuredScene(varied).render(sampled).error.maximum() > 2;
  EXPECT_GE(broken, 4);
}

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
  EXPECT_LE(measure(a_scene().pilot(), *choice.prepared).error().maximum(), 0.05);
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
  EXPECT_NEAR(measure(pilot, *predicted.method).error().mean(), whole, 0.5 * whole);
}

}  // namespace
}  // namespace metamer::promises
