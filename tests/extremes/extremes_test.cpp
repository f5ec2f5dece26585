#include <gtest/gtest.h>

#include "tests/extremes/builds.h"
#include "tests/extremes/gl_build.h"

namespace metamer::extremes {
namespace {

constexpr int most_told =
    20;  // Rows that miss the bound are told with their inputs; not thousands.

void expect_agreement(const std::vector<Row>& rows, const Values& values, Build build) {
  ASSERT_GT(rows.size(), 50u);
  ASSERT_EQ(rows.size(), values.size());
  int missed = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Bound allowed = bound(build, rows[i]);
    const Error error = compare(rows[i], values[i], allowed);
    if (error.within || ++missed > most_told) continue;
    ADD_FAILURE() << allowed.name << " is off by " << error.size << " at " << where(rows[i]) << ": "
                  << ::testing::PrintToString(values[i]) << " is not "
                  << ::testing::PrintToString(rows[i].values);
  }
  EXPECT_LE(missed, most_told) << "rows of " << rows[0].kind << " miss the bound";
}

TEST(Extremes, F64AgreesWithFiftyDigits) {
  for (const char* file : files)
    expect_agreement(table(file), evaluate_f64(table(file)), Build::f64);
}

TEST(Extremes, F32AgreesWithFiftyDigits) {
  for (const char* file : files)
    expect_agreement(table(file), evaluate_f32(table(file)), Build::f32);
}

TEST(Extremes, GlslAgreesWithFiftyDigits) {
  ASSERT_GT(gl::device_count(), 0) << "no EGL device, not even llvmpipe: see deploy/dependencies";
  auto build = GlBuild::create();
  ASSERT_TRUE(build) << build.error().message;
  for (const char* file : files) {
    const auto values = build->evaluate(table(file));
    ASSERT_TRUE(values) << values.error().message;
    expect_agreement(table(file), *values, Build::glsl);
  }
}

}  // namespace
}  // namespace metamer::extremes
