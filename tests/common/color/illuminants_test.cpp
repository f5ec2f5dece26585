#include "common/color/illuminants.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "common/color/chromaticity.h"
#include "common/color/xyz.h"
#include "common/spectral/cie.h"

namespace metamer {
namespace {

void expect_white(const std::string& name, double x, double y, double within) {
  const auto light = illuminant_named(name);
  ASSERT_TRUE(light) << name;
  const Xyz white = white_of(*light, cie::observer_1931());
  const double sum = white[0] + white[1] + white[2];
  EXPECT_NEAR(white[0] / sum, x, within) << name;
  EXPECT_NEAR(white[1] / sum, y, within) << name;
}

std::string fault_of(const std::string& name) {
  const auto light = illuminant_named(name);
  return light ? "no error" : light.error().message;
}

TEST(Illuminants, LinesHavePowersThatCanBeSummed) {
  const std::string zeros(150, '0');
  for (const std::string& number : {"1" + zeros, "0." + zeros + "1"}) {
    const auto light = illuminant_named("546nm:" + number);
    ASSERT_FALSE(light) << number;
    EXPECT_NE(light.error().message.find("a line's power lies in 1e-100..1e+100"),
              std::string::npos)
        << light.error().message;
  }
}

TEST(Illuminants, OfDaylightHaveTheChromaticitiesOfCie15) {
  // CIE 15:2004, table 3; the temperatures are the nominal ones times 1.4388 / 1.4380.
  expect_white("D:5003K", 0.3457, 0.3585, 2e-4);
  expect_white("D:5503K", 0.3324, 0.3474, 2e-4);
  expect_white("D:6504K", 0.3127, 0.3290, 2e-4);
  expect_white("D:7504K", 0.2990, 0.3149, 2e-4);
}

TEST(Illuminants, OfDaylightAreTheTablesOfCie15) {
  // CIE 15 rounds the shares of the components to three digits, and the tables to five.
  for (const auto& [name, formula] : {std::pair{"D65", "D:6504K"}, std::pair{"D75", "D:7504K"}}) {
    const Spectrum daylight = *illuminant_named(formula);
    ASSERT_NE(cie::illuminant(name), nullptr) << name;
    const Spectrum& table = *cie::illuminant(name);
    const double scale = resample(table, {560}, Outside::zero).values.front();
    const std::vector<double> values = resample(table, daylight.nm, Outside::zero).values;
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_NEAR(daylight.values[i], values[i] / scale, 2e-3) << name << " " << daylight.nm[i];
  }
}

TEST(Illuminants, OfDaylightByTheirNamesHaveTheChromaticitiesOfCie15) {
  // CIE 15:2004, table T.3, which sums by 5 nm; the largest difference that makes is of D50.
  expect_white("D50", 0.34567, 0.35850, 1e-4);
  expect_white("D55", 0.33242, 0.34743, 1e-4);
  expect_white("D65", 0.31272, 0.32903, 5e-5);
  expect_white("D75", 0.29902, 0.31485, 3e-5);
}

TEST(Illuminants, OfBlackBodiesLieOnThePlanckianLocus) {
  // CIE 15: A, which is 2856 K with c2 = 1.4388e-2 m K. The others are a plain sum over the
  // observer's table by 5 nm, in Python.
  expect_white("2856K", 0.4476, 0.4074, 1e-4);
  expect_white("6500K", 0.31353, 0.32363, 1e-4);
  expect_white("1000000K", 0.24013, 0.23442, 1e-4);
  for (const char* name : {"500K", "1000000K"}) {
    const Spectrum light = *illuminant_named(name);
    for (const double value : light.values) EXPECT_TRUE(std::isfinite(value)) << name;
  }
}

TEST(Illuminants, ByTheCiesNamesAreItsTables) {
  for (const std::string& name : cie::illuminant_names())
    EXPECT_EQ(*illuminant_named(name), *cie::illuminant(name));
}

TEST(Illuminants, SayWhatIsWrongWithAName) {
  EXPECT_EQ(fault_of("D66"), "\"D66\" is not a standard illuminant; did you mean \"D65\"?");
  EXPECT_EQ(fault_of("D:3000K"), "\"D:3000K\" is out of range: daylight may have 4000 to 25000 K");
  EXPECT_EQ(fault_of("499K"), "\"499K\" is out of range: a black body may have 500 to 1e+06 K");
  for (const char* name : {"D:3000K", "D:6504K", "499K", "2856K", "2856", "546.1nm", "436nm+12nm"})
    EXPECT_TRUE(names_formula(name)) << name;
  for (const char* name : {"D65", "D66", "K", "D:", "K2", "nm", "546nm+"})
    EXPECT_FALSE(names_formula(name)) << name;
  EXPECT_EQ(fault_of("D:4000K"), "no error");
  EXPECT_EQ(fault_of("D:25000K"), "no error");
  EXPECT_EQ(fault_of("5003.5K"), "no error");
  for (const char* name : {"", "K", "D:", "D:K", "nm", "+", "546nm:", "546nm+", "546nm:x", "nannm",
                           "1e3nm", "D:65", "-1K", "1e3K", "nanK", "infK", "2856 K", "D:6504"})
    EXPECT_NE(fault_of(name), "no error") << name;
}

TEST(Illuminants, ThatLackAUnitOrASignAreToldHowTheyAreWritten) {
  const std::string no = " is not a standard illuminant; ";
  for (const char* name :
       {"435.8:1+546", "435.8nm:1 + 546nm", "435.8 : 1+546nm", "435.8nm:1+546"}) {
    EXPECT_EQ(fault_of(name), quoted(name) + no + "a list of lines is \"435.8nm:1+546nm\"");
    EXPECT_TRUE(names_formula(name)) << name;
  }
  for (const char* name : {"a+b", "436+", "436nm:", "C:1", "+", ":"})
    EXPECT_FALSE(names_formula(name)) << name;
  for (const char* name : {"2856", "2856 K", "2856k"})
    EXPECT_EQ(fault_of(name), quoted(name) + no + "a black body of that temperature is \"2856K\"");
  for (const char* name : {"D:6504", "D6504", "D6504K", "d:6504K", "D:6504 K"})
    EXPECT_EQ(fault_of(name), quoted(name) + no + "daylight of that temperature is \"D:6504K\"");
  EXPECT_EQ(fault_of("546 nm"), "\"546 nm\"" + no + "a line is \"546nm\"");
}

TEST(Illuminants, OfLinesAreTheMixtureOfTheirColours) {
  // CIE 1931, 2°, x̄ ȳ z̄ at 435, 545 and 610 nm (CIE 15, table 5).
  expect_white("435nm", 0.1669, 0.0086, 1e-4);
  expect_white("545nm", 0.2658, 0.7243, 1e-4);
  const std::array<double, 3> at435 = {0.3285, 0.01684, 1.62296}, at610 = {1.0026, 0.503, 0.00034};
  std::array<double, 3> mixed{};
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += mixed[i] = 0.5 * at435[i] + 2 * at610[i];
  for (const char* name : {"435nm:0.5+610nm:2", "610nm:2+435nm:0.5", "610nm:4+435nm"})
    expect_white(name, mixed[0] / sum, mixed[1] / sum, 1e-4);
}

TEST(Illuminants, OfLinesThatNobodySeesOrWithoutPowerAreRefused) {
  EXPECT_EQ(fault_of("1064nm"),
            "\"1064nm\" is out of range: a line lies between 360 and 830 nm (it is 1064)");
  EXPECT_EQ(fault_of("546nm:0"), "\"546nm:0\": a line's power is above 0");
  EXPECT_EQ(fault_of("546nm:-1"), "\"546nm:-1\": a line's power is above 0");
  std::string many = "400nm";
  for (int i = 0; i < 256; ++i) many += "+500nm";
  EXPECT_EQ(fault_of(many), "at most 256 lines are possible");
}

}  // namespace
}  // namespace metamer
