// The table of options: laws that each row keeps, and the file that is made from it.

#include "server/service/ops/options.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "server/service/ops/config_file.h"
#include "server/service/ops/option_value.h"

namespace metamer::service::test {

namespace {

std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What is wrong with a text, as an administrator reads it.
std::string complaints(const std::string& text) {
  Settings settings;
  const auto read = read_config(text, "m.toml", settings);
  std::string all;
  if (!read)
    for (const Problem& problem : read.error()) all += format(problem) + "\n";
  return all;
}

/// A value that is not the default, as the file has it.
std::string other_value(const Option& option) {
  Settings settings;
  for (const OptionValue& value :
       {OptionValue(true), OptionValue(std::int64_t{7}), OptionValue(7.25), OptionValue("7MiB"),
        OptionValue("127.0.0.1:7"), OptionValue("reference"), OptionValue("debug"),
        OptionValue("json"), OptionValue("slurm"), OptionValue("avx2"), OptionValue("0660"),
        OptionValue(std::vector<std::string>{"127.0.0.1:7", "unix:/a \"b\\"})}) {
    const auto before = toml_text(option, settings);
    if (service::set(option, settings, value) && toml_text(option, settings) != before)
      return *toml_text(option, settings);
  }
  return {};
}

}  // namespace

TEST(Options, EachHasASentenceANameAndASectionOfTheFile) {
  std::set<std::string> names, sections{""};
  for (const Section& section : all_sections()) {
    EXPECT_TRUE(sections.insert(section.name).second) << section.name;
    EXPECT_TRUE(section.meaning.ends_with('.')) << section.name;
  }
  for (const Option& option : all_options()) {
    SCOPED_TRACE(option.name);
    EXPECT_TRUE(names.insert(option.name).second);
    EXPECT_EQ(option.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-"),
              std::string::npos);
    EXPECT_TRUE(sections.contains(option.section));
    EXPECT_GE(option.meaning.size(), 10u);
    EXPECT_FALSE(option.meaning.ends_with('.'));
    EXPECT_FALSE(std::isupper(static_cast<unsigned char>(option.meaning[0])));
  }
  for (const std::string& section : sections)
    EXPECT_TRUE(std::any_of(all_options().begin(), all_options().end(), [&](const Option& option) {
      return option.section == section;
    })) << section;
}

TEST(Options, EachDefaultIsAValueThatItMayHave) {
  const Settings defaults;
  for (const Option& option : all_options()) {
    if (option.section.empty()) continue;
    const auto value = toml_text(option, defaults);
    if (!value) continue;
    EXPECT_EQ(complaints("[" + option.section + "]\n" + option.name + " = " + *value), "");
  }
}

TEST(Options, EachValueIsReadAgainAsItWasPrinted) {
  const Settings defaults;
  EXPECT_EQ(complaints(config_text(defaults)), "");
  for (const Option& option : all_options()) {
    if (option.section.empty()) continue;
    SCOPED_TRACE(option.name);
    const std::string value = other_value(option);
    ASSERT_FALSE(value.empty());
    Settings settings, again;
    ASSERT_TRUE(
        read_config("[" + option.section + "]\n" + option.name + " = " + value, "", settings));
    EXPECT_EQ(toml_text(option, settings), value);
    const std::string printed = config_text(settings);
    EXPECT_NE(printed, config_text(defaults));
    ASSERT_TRUE(read_config(printed, "", again));
    EXPECT_EQ(config_text(again), printed);
  }
}

TEST(Options, NumbersOutsideTheirRangesAndOtherTypesAreLocatedErrors) {
  for (const Option& option : all_options()) {
    if (option.section.empty()) continue;
    SCOPED_TRACE(option.name);
    const std::string place = "m.toml:2:" + std::to_string(option.name.size() + 4);
    for (const char* value : {"-1", "9223372036854775807", "1979-05-27", "nan", "inf", "[1]",
                              "{a = 1}", "\"\\u0000\"", "[\"\\u0000\"]", "[[]]"}) {
      const std::string said =
          complaints("[" + option.section + "]\n" + option.name + " = " + value);
      EXPECT_TRUE(said.starts_with(place + ": error: " + option.name + ": ")) << value << said;
    }
  }
}

TEST(Options, AWrongFileIsToldLineByLine) {
  EXPECT_EQ(
      complaints("[log]\nlog-levle = \"info\"\n[stroe]\nstore = 3\n"),
      "m.toml:2:1: error: [log] has no option \"log-levle\"; did you mean \"log-level\"?\n"
      "m.toml:3:2: error: there is no section or option \"stroe\"; did you mean \"store\"?\n");
  EXPECT_EQ(complaints("[log]\nlog-level = \"inof\"\n"),
            "m.toml:2:13: error: log-level: expected one of trace, debug, info, warn, error, off, "
            "not \"inof\"; did you mean \"info\"?\n");
  EXPECT_EQ(complaints("keep-bytes = 3\n[log]\nkeep-bytes = 4\n"),
            "m.toml:1:1: error: there is no section or option \"keep-bytes\"; it is in [store]\n"
            "m.toml:3:1: error: [log] has no option \"keep-bytes\"; it is in [store]\n");
  EXPECT_EQ(complaints("[workers]\nthreads = 1000\nworker-timeout = \"long\"\n"),
            "m.toml:2:11: error: threads: expected a whole number from 0 to 256\n"
            "m.toml:3:18: error: worker-timeout: expected seconds from 0.05 to 3600\n");
  EXPECT_EQ(complaints("log = 3"), "m.toml:1:7: error: \"log\" is a section: [log]\n");
  EXPECT_TRUE(complaints("[log]\nlog-level = ").starts_with("m.toml:2:"));
  EXPECT_TRUE(complaints(std::string(100'000, '[')).starts_with("m.toml:1:"));
  EXPECT_NE(complaints("\xff\xfe"), "");
}

TEST(Options, BytesMayBeSaidInTheUsualUnits) {
  Settings settings;
  for (const auto& [text, bytes] :
       std::vector<std::pair<std::string, std::uint64_t>>{{"17", 17},
                                                          {"\"17\"", 17},
                                                          {"\"2KiB\"", 2048},
                                                          {"\"300 MB\"", 300ull << 20},
                                                          {"\"3g\"", 3ull << 30}}) {
    ASSERT_TRUE(read_config("[store]\nstore-bytes = " + text, "", settings)) << text;
    EXPECT_EQ(settings.service.store_bytes, bytes) << text;
  }
  for (const char* text : {"\"\"", "\"GiB\"", "\"-3GiB\"", "\"99999999999999999999\"", "\"16EiB\"",
                           "\"999999EiB\"", "3.5"})
    EXPECT_FALSE(read_config(std::string("[store]\nstore-bytes = ") + text, "", settings)) << text;
}

TEST(Options, TheDeliveredFileIsWhatTheProgramPrints) {
  EXPECT_EQ(text_of_file(METAMER_TEST_DATA "/../deploy/metamerd.toml"), config_text(Settings{}))
      << "run metamerd --print-config > deploy/metamerd.toml";
}

}  // namespace metamer::service::test
