// What was promised, beside what was measured.
#include "client/tools/text/promise_text.h"

#include <gtest/gtest.h>

namespace metamer::client {
namespace {

v1::Finished measured(bool kept) {
  v1::Finished finished;
  finished.mutable_timing()->set_total(2.5);
  finished.mutable_accuracy()->set_kept(kept);
  v1::ColorError& error = *finished.mutable_accuracy()->mutable_error();
  error.set_pixels(500);
  error.set_mean(0.125);
  error.set_percentile_95(0.25);
  error.set_maximum(0.75);
  return finished;
}

const char* const measures =
    "exact: ΔE00 against the reference, on 500 pixels that had no part in the choice: mean "
    "0.125, 95 % below 0.25, at most 0.75";

TEST(PromiseText, OfATolerance) {
  v1::Plan plan;
  plan.mutable_method()->mutable_exact();
  plan.mutable_auto_()->set_tolerance(0.5);
  const auto promise = promise_text(plan, measured(false));
  ASSERT_TRUE(promise);
  EXPECT_FALSE(promise->kept);
  EXPECT_EQ(promise->text, measures + std::string("; at most 0.5 was asked for"));
}

TEST(PromiseText, OfADeadline) {
  v1::Plan plan;
  plan.mutable_method()->mutable_exact();
  plan.mutable_auto_()->set_deadline(2);
  const auto promise = promise_text(plan, measured(true));
  ASSERT_TRUE(promise);
  EXPECT_TRUE(promise->kept);
  EXPECT_EQ(promise->text, measures + std::string("; it took 2.5 s, and 2 s were asked for"));
}

TEST(PromiseText, IsNoneWhereNothingWasPromisedOrMeasured) {
  v1::Plan plan;
  EXPECT_FALSE(promise_text(plan, measured(true)));
  plan.mutable_auto_()->set_deadline(2);
  EXPECT_FALSE(promise_text(plan, {}));
}

}  // namespace
}  // namespace metamer::client
