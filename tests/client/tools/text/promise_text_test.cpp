// What was promised, beside what was measured.
#include "client/tools/text/promise_text.h"

#include <gtest/gtest.h>

namespace metamer::client {
namespace {

v1::Plan planned() {
  v1::Plan plan;
  plan.set_width(640);
  plan.set_height(480);
  plan.mutable_method()->mutable_exact();
  return plan;
}

/// On pixels that bound `share` of all.
v1::Finished measured(bool kept, double share = 0.994165) {
  v1::Finished finished;
  finished.mutable_timing()->set_total(2.5);
  v1::Accuracy& accuracy = *finished.mutable_accuracy();
  accuracy.set_kept(kept);
  accuracy.set_observer(v1::CIE_1964_10DEG);
  for (const double value : {0.9481, 1.0, 1.0733}) accuracy.add_white(value);
  v1::ColorError& error = *accuracy.mutable_error();
  error.set_pixels(512);
  error.set_mean(0.125);
  error.set_percentile_95(0.25);
  error.set_maximum(0.75);
  error.set_share(share);
  return finished;
}

const char* const measures =
    "exact: ΔE00 against the reference, on 512 of 307200 pixels drawn at random: mean 0.125, 95 % "
    "below 0.25, at most 0.75, as are 99.4 % of all with 95 % confidence (cie-1964-10deg, white X "
    "0.9481 Y 1 Z 1.073)";

TEST(PromiseText, OfATolerance) {
  v1::Plan plan = planned();
  plan.mutable_auto_()->set_tolerance(0.5);
  const auto promise = promise_text(plan, measured(false));
  ASSERT_TRUE(promise);
  EXPECT_FALSE(promise->kept);
  EXPECT_EQ(promise->text, measures + std::string("; at most 0.5 was asked for"));
}

TEST(PromiseText, OfADeadline) {
  v1::Plan plan = planned();
  plan.mutable_auto_()->set_deadline(2);
  const auto promise = promise_text(plan, measured(true));
  ASSERT_TRUE(promise);
  EXPECT_TRUE(promise->kept);
  EXPECT_EQ(promise->text, measures + std::string("; it took 2.5 s, and 2 s were asked for"));
}

TEST(PromiseText, OfAPictureThatWasVerifiedNeedsNoConfidenceAndNoPromise) {
  const auto promise = promise_text(planned(), measured(false, 1));
  ASSERT_TRUE(promise);
  EXPECT_TRUE(promise->kept) << "nothing was promised";
  EXPECT_EQ(promise->text,
            "exact: ΔE00 against the reference, on all 307200 pixels: mean 0.125, 95 % below 0.25, "
            "at most 0.75 (cie-1964-10deg, white X 0.9481 Y 1 Z 1.073)");
}

TEST(PromiseText, RoundsNoShareUpToAllPixels) {
  const std::string text = promise_text(planned(), measured(true, 0.99999))->text;
  EXPECT_NE(text.find("as are 99.9 % of all"), std::string::npos) << text;
}

TEST(PromiseText, OfAnOlderServerSaysNothingOfTheOtherPixels) {
  v1::Finished finished = measured(true, 0);
  finished.mutable_accuracy()->clear_white();
  EXPECT_EQ(promise_text(planned(), finished)->text,
            "exact: ΔE00 against the reference, on 512 of 307200 pixels: mean 0.125, 95 % below "
            "0.25, at most 0.75");
}

TEST(PromiseText, IsNoneWhereNothingWasMeasured) {
  v1::Plan plan = planned();
  plan.mutable_auto_()->set_deadline(2);
  EXPECT_FALSE(promise_text(plan, {}));
}

}  // namespace
}  // namespace metamer::client
