// What is known of methods, as values: predictions, a trade, what came of them.
#include "client/gui/methods/known_methods.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include "common/scene/methods.h"
#include "common/scene/settings.h"

namespace metamer::gui {
namespace {

v1::Scene scene_with(const std::string& settings) {
  v1::Scene scene;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(
      "camera { eye { z: 4 } } settings { width: 40 height: 20 spp: 4 " + settings + " }", &scene));
  return scene;
}

v1::Method method_of(const std::string& text) {
  return with_defaults(scene_with("method { " + text + " }").settings()).method();
}

/// Predictions of all candidates: each a tenth of a second dearer than the one before, and half as
/// far off.
v1::Plan plan_of_candidates() {
  v1::Plan plan;
  plan.set_width(40);
  plan.set_height(20);
  double seconds = 1, error = 8;
  for (const v1::Method& method : candidates()) {
    v1::Prediction& one = *plan.add_prediction();
    *one.mutable_method() = method;
    one.set_prepare(0.25);
    one.set_render(seconds - 0.25);
    one.mutable_error()->set_maximum(error);
    one.mutable_error()->set_percentile_95(error / 2);
    one.mutable_error()->set_mean(error / 4);
    one.mutable_error()->set_pixels(256);
    one.set_bound(error * 1.5);
    seconds += 0.1;
    error /= 2;
  }
  return plan;
}

int used_row(const KnownMethods& known) {
  int found = -1;
  for (int i = 0; i < known.rows().size(); ++i)
    if (known.rows()[i].chosen) {
      EXPECT_EQ(found, -1) << "one is used";
      found = i;
    }
  return found;
}

TEST(KnownMethods, HaveEveryPredictionAsARowAndAPoint) {
  const v1::Plan plan = plan_of_candidates();
  const KnownMethods known = KnownMethods::predicted(scene_with(""), plan);
  ASSERT_EQ(known.rows().size(), plan.prediction_size());
  const auto points = method_points(known.rows(), ErrorFigure::maximum, 1.0);
  ASSERT_EQ(points.size(), known.rows().size());
  for (int i = 0; i < points.size(); ++i) {
    const v1::Prediction& one = plan.prediction(i);
    EXPECT_EQ(known.rows()[i].name.toStdString(), method_text(one.method()));
    EXPECT_DOUBLE_EQ(points[i].x, one.prepare() + one.render());
    EXPECT_DOUBLE_EQ(points[i].y, one.error().maximum());
    EXPECT_DOUBLE_EQ(points[i].whisker, one.bound());
    EXPECT_TRUE(points[i].front) << "each is better than all that are cheaper";
    EXPECT_EQ(points[i].faint, one.bound() > 1) << "what a tolerance of 1 leaves out";
    EXPECT_TRUE(points[i].family >= 0 && points[i].family < method_families().size());
  }
  const auto means = method_points(known.rows(), ErrorFigure::mean, 1.0);
  EXPECT_DOUBLE_EQ(means[0].y, plan.prediction(0).error().mean());
}

TEST(KnownMethods, TheOneThatIsUsedIsMarkedForEveryMethodAndFollowsTheSettings) {
  KnownMethods known = KnownMethods::predicted(scene_with(""), plan_of_candidates());
  EXPECT_EQ(known.rows()[used_row(known)].name, QStringLiteral("exact")) << "by default";
  for (const MethodRow& row : QList<MethodRow>(known.rows())) {
    v1::Settings settings;
    *settings.mutable_method() = row.method;
    known.mark_used(settings);
    ASSERT_GE(used_row(known), 0) << row.name.toStdString();
    EXPECT_EQ(known.rows()[used_row(known)].name, row.name);
  }
  known.mark_used(scene_with("method { point { from: 400 to: 700 step: 7.5 } }").settings());
  EXPECT_EQ(used_row(known), -1);
  EXPECT_TRUE(known.heading().contains(QStringLiteral("400:700:7.5")));
}

TEST(KnownMethods, APointMethodIsItsOwnWhicheverLightsTheServerChoseForIt) {
  v1::Plan plan = plan_of_candidates();
  v1::Method own = method_of("point { from: 400 to: 700 step: 5 }");
  const v1::Scene scene = scene_with("method { point { from: 400 to: 700 step: 5 } }");
  own.mutable_point()->set_lights(v1::Point::CELLS);
  *plan.mutable_prediction(2)->mutable_method() = own;
  EXPECT_EQ(used_row(KnownMethods::predicted(scene, plan)), 2);
  *plan.mutable_prediction(4)->mutable_method() = method_of("point { from: 400 to: 700 step: 5 }");
  EXPECT_EQ(used_row(KnownMethods::predicted(scene, plan)), 4) << "the very same comes first";
  EXPECT_EQ(asked_method(own).point().lights(), v1::Point::BETTER);
}

TEST(KnownMethods, AGoalsChoiceIsTheServersAndOfThatGoalAlone) {
  const v1::Scene scene = scene_with("goal { tolerance: 0.5 }");
  v1::Plan plan = plan_of_candidates();
  *plan.mutable_method() = candidates()[2];
  KnownMethods known = KnownMethods::predicted(scene, plan);
  EXPECT_EQ(used_row(known), 2);
  EXPECT_TRUE(known.knows_choice(scene.settings()));
  EXPECT_TRUE(known.knows_choice(scene_with("goal {}").settings())) << "0.5 by default";
  const v1::Settings other = scene_with("goal { tolerance: 0.4 }").settings();
  EXPECT_FALSE(known.knows_choice(other));
  known.mark_used(other);
  EXPECT_EQ(used_row(known), -1);
  known.set_choice(other, candidates()[4]);
  EXPECT_EQ(used_row(known), 4);
}

TEST(KnownMethods, HoldOfScenesThatDifferInMethodAndGoalAlone) {
  const KnownMethods known =
      KnownMethods::predicted(scene_with("method { rgb {} }"), plan_of_candidates());
  EXPECT_TRUE(known.hold_of(scene_with("goal { tolerance: 3 } threads: 1 verify: true")));
  EXPECT_FALSE(known.hold_of(scene_with("observer: CIE_1964_10DEG")));
  v1::Scene lit = scene_with("");
  lit.add_light();
  EXPECT_FALSE(known.hold_of(lit));
}

TEST(KnownMethods, WhatCameOfAJobJoinsItsMethod) {
  KnownMethods known = KnownMethods::predicted(scene_with(""), plan_of_candidates());
  v1::Plan plan;
  *plan.mutable_method() = candidates()[1];
  v1::Finished finished;
  finished.mutable_timing()->set_prepare(0.5);
  finished.mutable_timing()->set_render(1.5);
  known.add_job(QStringLiteral("job 7"), plan, finished);
  ASSERT_TRUE(known.rows()[1].came);
  EXPECT_EQ(known.rows()[1].came->seconds, 2);
  EXPECT_FALSE(known.rows()[1].came->error);
  auto points = method_points(known.rows(), ErrorFigure::maximum, {});
  EXPECT_EQ(points[1].came, QPointF(2, points[1].y)) << "what was not measured is as predicted";

  finished.mutable_accuracy()->mutable_error()->set_maximum(0.125);
  known.add_job(QStringLiteral("job 8"), plan, finished);
  points = method_points(known.rows(), ErrorFigure::maximum, {});
  EXPECT_EQ(points[1].came, QPointF(2, 0.125));
  *plan.mutable_method() = method_of("point { from: 400 to: 700 step: 7.5 }");
  known.add_job(QStringLiteral("job 9"), plan, finished);
  for (int i = 0; i < points.size(); ++i) EXPECT_EQ(known.rows()[i].came.has_value(), i == 1);
}

TEST(KnownMethods, AFrameIsReckonedUpToThePicture) {
  KnownMethods known = KnownMethods::predicted(scene_with(""), plan_of_candidates());
  v1::Plan plan;
  *plan.mutable_method() = candidates()[3];
  plan.set_width(20);
  plan.set_height(10);
  v1::Frame frame;
  frame.set_render(0.5);
  known.add_frame(plan, frame);
  EXPECT_FALSE(known.rows()[3].came) << "it is not complete";
  frame.set_complete(true);
  known.add_frame(plan, frame);
  ASSERT_TRUE(known.rows()[3].came);
  EXPECT_EQ(known.rows()[3].came->seconds, 0.5 * 4 * 4) << "4 samples of 4 times the pixels";
  v1::Finished finished;
  finished.mutable_timing()->set_render(1);
  known.add_job(QStringLiteral("job 7"), plan, finished);
  known.add_frame(plan, frame);
  EXPECT_EQ(known.rows()[3].came->seconds, 1) << "a job's own time stays";
}

TEST(KnownMethods, OfATradeTheQuickestComesFirstAndWhatFailedLastWithItsReason) {
  auto tradeoff = std::make_shared<client::Tradeoff>();
  tradeoff->rounds = 2;
  double seconds = 40;
  for (const client::TradeoffCase& one : client::tradeoff_cases()) {
    client::TradeoffRow row;
    row.what = one;
    row.render = seconds--;
    row.error.maximum = seconds;
    row.error.percentile_95 = seconds / 2;
    tradeoff->rows.push_back(row);
  }
  tradeoff->rows[3].failure = "no such method";
  client::mark_front(tradeoff->rows);
  const KnownMethods known = KnownMethods::measured(scene_with(""), tradeoff);
  ASSERT_EQ(known.rows().size(), static_cast<qsizetype>(client::tradeoff_cases().size()));
  EXPECT_EQ(known.rows().back().failure, QStringLiteral("no such method"));
  const std::vector<bool> front = front_of(known.rows(), ErrorFigure::percentile_95);
  EXPECT_FALSE(front.back());
  for (int i = 1; i + 1 < known.rows().size(); ++i)
    EXPECT_LE(known.rows()[i - 1].seconds, known.rows()[i].seconds);
  for (const client::TradeoffRow& row : tradeoff->rows)
    for (int i = 0; i < known.rows().size(); ++i)
      if (known.rows()[i].name.toStdString() == method_text(row.what.settings)) {
        EXPECT_EQ(front[static_cast<std::size_t>(i)], row.front) << row.what.stem;
      }
  EXPECT_EQ(method_points(known.rows(), ErrorFigure::maximum, {}).size(), known.rows().size() - 1);
}

TEST(KnownMethods, SayThatCostsAreAlike) {
  v1::Plan plan = plan_of_candidates();
  for (v1::Prediction& one : *plan.mutable_prediction()) one.set_render(2 + 0.01 * one.bound());
  EXPECT_TRUE(KnownMethods::predicted(scene_with(""), plan)
                  .heading()
                  .contains(QStringLiteral("linear around")));
  plan.mutable_prediction(0)->set_render(9);
  EXPECT_FALSE(KnownMethods::predicted(scene_with(""), plan)
                   .heading()
                   .contains(QStringLiteral("linear around")));
}

}  // namespace
}  // namespace metamer::gui
