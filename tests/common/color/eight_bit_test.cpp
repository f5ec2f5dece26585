#include "common/color/eight_bit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace metamer {
namespace {

/// 255 · encode, rounded, without any table.
int by_the_formula(const Transfer& transfer, float linear) {
  const double code = 255 * encode(transfer, static_cast<double>(linear));
  return static_cast<int>(std::lround(std::min(255.0, std::max(0.0, code))));
}

TEST(EightBit, IsTheFormulasNearestCodeInEverySpace) {
  std::vector<Transfer> transfers = {Transfer{}, Transfer{.gamma = 1e-3}, Transfer{.gamma = 1e3}};
  for (const std::string& word : rgb_space_words())
    transfers.push_back(find_rgb_space(word)->transfer);
  std::mt19937 random(7);
  std::uniform_real_distribution<float> anywhere(-0.2f, 1.2f), exponent(-40, 1);
  for (const Transfer& transfer : transfers) {
    SCOPED_TRACE(transfer.gamma);
    const EightBit codes(transfer);
    for (int i = 0; i < 20'000; ++i) {
      const float value = i % 2 ? anywhere(random) : std::exp2(exponent(random));
      ASSERT_EQ(codes(value), by_the_formula(transfer, value)) << value;
    }
    // And on both sides of every change.
    for (int code = 1; code <= 255; ++code) {
      auto value = static_cast<float>(decode(transfer, (code - 0.5) / 255));
      for (int step = -3; step <= 3; ++step) {
        float near = value;
        for (int k = 0; k < std::abs(step); ++k)
          near = std::nextafter(near, step < 0 ? -2.0f : 2.0f);
        ASSERT_EQ(codes(near), by_the_formula(transfer, near)) << code << ' ' << step;
      }
    }
  }
}

TEST(EightBit, ManyAreWhatEachIs) {
  std::vector<Transfer> transfers = {Transfer{}, Transfer{.gamma = 1e-3}, Transfer{.gamma = 1e3}};
  for (const std::string& word : rgb_space_words())
    transfers.push_back(find_rgb_space(word)->transfer);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> anywhere(-0.2f, 1.2f), exponent(-40, 1);
  constexpr float infinity = std::numeric_limits<float>::infinity();
  std::vector<float> values = {infinity, -infinity, std::numeric_limits<float>::quiet_NaN(), 0, 1};
  while (values.size() < 5000)
    values.push_back(values.size() % 2 ? anywhere(random) : std::exp2(exponent(random)));
  for (const Transfer& transfer : transfers) {
    SCOPED_TRACE(transfer.gamma);
    const EightBit codes(transfer);
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{1}, std::size_t{256}, std::size_t{257}, values.size()}) {
      std::vector<std::uint8_t> many(count + 1, 77);
      codes(std::span(values).first(count), many.data());
      for (std::size_t i = 0; i < count; ++i) ASSERT_EQ(many[i], codes(values[i])) << values[i];
      EXPECT_EQ(many.back(), 77) << "nothing is written behind the last";
    }
  }
}

TEST(EightBit, SaysWhatClippingLoses) {
  const EightBit codes(rgb_space(StandardSpace::srgb).transfer);
  constexpr float infinity = std::numeric_limits<float>::infinity();
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(codes(nan), 0);
  EXPECT_EQ(codes(-infinity), 0);
  EXPECT_EQ(codes(infinity), 255);
  for (const float value : {nan, -infinity, -0.001f}) EXPECT_TRUE(codes.is_below(value)) << value;
  for (const float value : {infinity, 1.01f}) EXPECT_TRUE(codes.is_above(value)) << value;
  // Half a step is what rounding loses anyway.
  for (const float value : {-0.0001f, 0.0f, 0.5f, 1.0f, 1.002f}) {
    EXPECT_FALSE(codes.is_below(value)) << value;
    EXPECT_FALSE(codes.is_above(value)) << value;
  }
}

}  // namespace
}  // namespace metamer
