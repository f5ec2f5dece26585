#include "common/spectral/wavelengths.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace metamer {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

std::string uniform_error(double from, double to, double step) {
  const auto result = Wavelengths::uniform(from, to, step);
  return result ? "no error" : result.error().message;
}

std::string listed_error(std::vector<double> nm) {
  const auto result = Wavelengths::listed(std::move(nm));
  return result ? "no error" : result.error().message;
}

TEST(Wavelengths, From400To700By5Are61) {
  const auto wavelengths = Wavelengths::uniform(400, 700, 5);
  ASSERT_TRUE(wavelengths);
  ASSERT_EQ(wavelengths->size(), 61U);
  for (std::size_t i = 0; i < 61; ++i) {
    EXPECT_EQ(wavelengths->nm()[i], 400 + 5 * static_cast<double>(i));
    EXPECT_EQ(wavelengths->widths()[i], 5);
  }
}

TEST(Wavelengths, HaveTheCellWidthsOfFigure42) {
  // Neighbours 10, 30, 60 nm apart: the ends take the whole distance, the inner ones the mean.
  const auto wavelengths = Wavelengths::listed({400, 410, 440, 500});
  ASSERT_TRUE(wavelengths);
  EXPECT_EQ(wavelengths->widths(), (std::vector<double>{10, 20, 45, 60}));
  EXPECT_EQ(Wavelengths::listed({400, 410})->widths(), (std::vector<double>{10, 10}));
}

TEST(Wavelengths, ASingleOneHasTheWidth1) {
  EXPECT_EQ(Wavelengths::listed({555})->widths(), std::vector<double>{1});
  EXPECT_EQ(Wavelengths::uniform(555, 555, 5)->nm(), std::vector<double>{555});
  EXPECT_EQ(Wavelengths::uniform(555, 555, 5)->widths(), std::vector<double>{1});
}

TEST(Wavelengths, ReachTheEndInSpiteOfRounding) {
  // 0.1 has no exact double: 300/0.1 is a little off 3000.
  const auto wavelengths = Wavelengths::uniform(400, 700, 0.1);
  ASSERT_TRUE(wavelengths);
  EXPECT_EQ(wavelengths->size(), 3001U);
  EXPECT_EQ(wavelengths->nm().back(), 700);
  EXPECT_EQ(Wavelengths::uniform(0.1, 0.3, 0.1)->nm().back(), 0.3) << "0.1 + 2 × 0.1 is more";
  // A tenth of a millionth of a step below the end still counts, a hundredth of a step does not.
  EXPECT_EQ(Wavelengths::uniform(400, 410 - 1e-7, 1)->size(), 11U);
  EXPECT_EQ(Wavelengths::uniform(400, 409.99, 1)->size(), 10U);
}

TEST(Wavelengths, StopBeforeAnEndThatIsNoMultiple) {
  EXPECT_EQ(Wavelengths::uniform(400, 707, 100)->nm(), (std::vector<double>{400, 500, 600, 700}));
}

TEST(Wavelengths, AreAtMost4001) {
  EXPECT_EQ(Wavelengths::uniform(300, 700, 0.1)->size(), 4001U);
  EXPECT_EQ(uniform_error(300, 700.1, 0.1),
            "at most 4001 wavelengths are possible; 300 to 700.1 by 0.1 are more");
  EXPECT_EQ(uniform_error(1, 1e308, 1e-308),
            "at most 4001 wavelengths are possible; 1 to 1e+308 by 1e-308 are more");
  std::vector<double> many(4002);
  std::iota(many.begin(), many.end(), 1.0);
  EXPECT_EQ(listed_error(many), "at most 4001 wavelengths are possible, not 4002");
  many.pop_back();
  EXPECT_EQ(listed_error(many), "no error");
}

TEST(Wavelengths, UniformSayWhatIsWrong) {
  EXPECT_EQ(uniform_error(nan, 700, 5), "wavelengths must be finite numbers, not nan");
  EXPECT_EQ(uniform_error(400, infinity, 5), "wavelengths must be finite numbers, not inf");
  EXPECT_EQ(uniform_error(400, 700, -infinity), "wavelengths must be finite numbers, not -inf");
  EXPECT_EQ(uniform_error(0, 700, 5), "wavelength 0 must be above 0 nm");
  EXPECT_EQ(uniform_error(700, 400, 5), "the last wavelength, 400, is below the first, 700");
  EXPECT_EQ(uniform_error(400, 700, 0), "the step must be above 0 nm, not 0");
  EXPECT_EQ(uniform_error(400, 700, -5), "the step must be above 0 nm, not -5");
  EXPECT_EQ(uniform_error(1e18, 1e18 + 1000, 1), "wavelength 1e+18 is repeated")
      << "a step that a double can't add";
}

TEST(Wavelengths, ListedNameTheOffendingPair) {
  EXPECT_EQ(listed_error({}), "no wavelengths");
  EXPECT_EQ(listed_error({400, 460, 450}), "wavelengths must rise: 450 follows 460");
  EXPECT_EQ(listed_error({400, 450, 450}), "wavelength 450 is repeated");
  EXPECT_EQ(listed_error({-1, 450}), "wavelength -1 must be above 0 nm");
  EXPECT_EQ(listed_error({400, nan}), "wavelength nan is not finite");
  EXPECT_EQ(listed_error({400, infinity}), "wavelength inf is not finite");
}

}  // namespace
}  // namespace metamer
