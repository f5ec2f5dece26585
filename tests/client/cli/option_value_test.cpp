// Each option that changes a scene takes the values of a sweep as it takes those of its words.
#include "client/cli/option_value.h"

#include <gtest/gtest.h>

#include "client/cli/shared_options.h"

namespace metamer::cli {
namespace {

TEST(OptionValue, EachOptionOfASceneTakesOne) {
  Overrides overrides;
  Options options;
  declare_overrides(overrides, options);
  ASSERT_GE(options.size(), 20u);
  for (const Option& option : options) {
    const bool is_number = std::holds_alternative<std::optional<std::uint32_t>*>(option.target) ||
                           std::holds_alternative<std::optional<double>*>(option.target);
    const bool is_flag = std::holds_alternative<bool*>(option.target);
    const auto set = set_value(option, is_number ? "7" : is_flag ? "on" : "word");
    EXPECT_TRUE(set) << option.names << ": " << set.error().message;
    if (is_number || is_flag) {
      EXPECT_FALSE(set_value(option, "word")) << option.names;
    }
  }
  EXPECT_EQ(overrides.spp, 7u);
  EXPECT_EQ(overrides.tolerance, 7);
  EXPECT_EQ(overrides.method, "word");
  EXPECT_TRUE(overrides.verify);
  EXPECT_EQ(overrides.lights, std::vector<std::string>{"word"});
}

TEST(OptionValue, WhatTheOptionDoesNotTakeIsRefused) {
  std::uint32_t count = 0;
  double number = 0;
  std::string word;
  const auto refuses = [](const Option& option, const char* text) {
    EXPECT_FALSE(set_value(option, text)) << text;
  };
  for (const char* text : {"-1", "4294967296", "1.5", "", " 1", "nan"})
    refuses({.names = "--count", .target = &count, .meaning = ""}, text);
  const Option ranged{.names = "--n", .target = &count, .meaning = "", .range = {{1, 3}}};
  for (const char* text : {"0", "4"}) refuses(ranged, text);
  EXPECT_TRUE(set_value(ranged, "3"));
  refuses({.names = "--x", .target = &number, .meaning = ""}, "nan");
  refuses({.names = "--x", .target = &number, .meaning = "", .sign = Option::Sign::positive}, "0");
  refuses({.names = "--x", .target = &number, .meaning = "", .sign = Option::Sign::not_negative},
          "-1e-9");
  const Option chosen{.names = "--w", .target = &word, .meaning = "", .choices = {"lines", "astm"}};
  refuses(chosen, "line");
  EXPECT_TRUE(set_value(chosen, "astm"));
}

}  // namespace
}  // namespace metamer::cli
