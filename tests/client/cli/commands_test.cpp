// Every subcommand that commands.def lists has its help, and takes no word that it does not know.
#include "client/cli/commands.h"

#include <gtest/gtest.h>

#include <iterator>
#include <set>
#include <sstream>

#include "client/cli/parse.h"

namespace metamer::cli {
namespace {

std::vector<std::string> words_of(const Command& command, const std::string& more) {
  std::istringstream stream(command.name);
  std::vector<std::string> words{std::istream_iterator<std::string>(stream), {}};
  words.push_back(more);
  return words;
}

TEST(Commands, AreNamedOnceAndBelowWhatIsThere) {
  std::set<std::string> names;
  for (const Command& command : all_commands()) {
    const std::size_t space = command.name.rfind(' ');
    EXPECT_TRUE(space == std::string::npos || names.contains(command.name.substr(0, space)))
        << command.name;
    EXPECT_TRUE(names.insert(command.name).second) << command.name;
  }
  EXPECT_GE(names.size(), 30u);
}

TEST(Commands, EachHasHelpWithTheExitCodes) {
  const std::vector<Command> commands = all_commands();
  for (const Command& command : commands) {
    const Parsed parsed = parse(commands, "metamer", words_of(command, "--help"));
    EXPECT_EQ(parsed.code, ExitCode::done) << command.name;
    EXPECT_FALSE(parsed.run) << command.name;
    EXPECT_EQ(parsed.out.substr(0, command.meaning.size() + 1), command.meaning + "\n");
    EXPECT_NE(parsed.out.find("Usage: metamer " + command.name + " "), std::string::npos)
        << parsed.out;
    EXPECT_NE(parsed.out.find("Exit codes: 0 done, 2 bad input"), std::string::npos);
    for (const Option& option : command.options)
      EXPECT_NE(parsed.out.find(option.meaning.substr(0, 12)), std::string::npos) << option.names;
  }
}

TEST(Commands, EachRefusesAnUnknownOption) {
  const std::vector<Command> commands = all_commands();
  for (const Command& command : commands) {
    const Parsed parsed = parse(commands, "metamer", words_of(command, "--no-such-option"));
    EXPECT_EQ(parsed.code, ExitCode::bad_input) << command.name;
    EXPECT_FALSE(parsed.run) << command.name;
    EXPECT_FALSE(parsed.fault.empty()) << command.name;
    EXPECT_NE(parsed.err.find(parsed.fault), std::string::npos) << command.name;
  }
}

TEST(Commands, EachStandsInTheHelpAboveIt) {
  const std::vector<Command> commands = all_commands();
  for (const Command& command : commands) {
    const std::size_t space = command.name.rfind(' ');
    std::vector<std::string> above = {"--help"};
    if (space != std::string::npos) above.insert(above.begin(), command.name.substr(0, space));
    const std::string help = parse(commands, "metamer", above).out;
    const std::size_t at = help.find("\n  " + command.name.substr(space + 1) + " ");
    ASSERT_NE(at, std::string::npos) << command.name;
    EXPECT_LT(help.find(command.meaning, at), help.find('\n', help.find(command.meaning, at)));
  }
}

/// A subcommand with an option of each type.
struct Everything {
  bool flag = false, given_above = false;
  std::string text = "before", word;
  std::optional<std::string> maybe_text, kept;
  std::vector<std::string> texts, rest;
  std::uint32_t count = 0;
  std::optional<std::uint32_t> maybe_count;
  std::vector<std::uint32_t> counts;
  std::uint64_t big = 0;
  double number = 0;
  std::optional<double> maybe_number;
};
Everything seen;

void declare(Everything& v, std::vector<Option>& options) {
  const auto add = [&](const char* names, Target target) -> Option& {
    options.push_back({.names = names, .target = target, .meaning = "of this"});
    return options.back();
  };
  add("--flag", &v.flag);
  add("--text", &v.text).choices = {"a", "b"};
  add("--maybe-text", &v.maybe_text);
  add("--kept", &v.kept).value_optional = true;
  add("-t,--texts", &v.texts);
  add("--count", &v.count).range = {{1, 3}};
  add("--maybe-count", &v.maybe_count);
  add("--counts", &v.counts).separator = ',';
  add("--big", &v.big);
  add("--number", &v.number).sign = Option::Sign::positive;
  add("--maybe-number", &v.maybe_number).sign = Option::Sign::not_negative;
  add("word", &v.word).required = true;
  add("rest", &v.rest);
}

ExitCode run(const Everything& values) {
  seen = values;
  return ExitCode::promise_broken;
}

class Parsing : public testing::Test {
 protected:
  Parsed parse(const std::vector<std::string>& words) {
    return cli::parse(commands, "metamer", words);
  }
  std::vector<Command> commands = {make_command<Everything>("every", "of each type", declare, run)};
};

TEST_F(Parsing, EachTypeOfOptionTakesItsValue) {
  const Parsed parsed = parse({"every",
                               "-t",
                               "x",
                               "here",
                               "--flag",
                               "--text",
                               "b",
                               "--texts",
                               "y",
                               "--kept",
                               "--count",
                               "3",
                               "--counts",
                               "1,2",
                               "--big",
                               "18446744073709551615",
                               "--number",
                               "1e-3",
                               "--maybe-number",
                               "0",
                               "r1",
                               "r2"});
  ASSERT_TRUE(parsed.run) << parsed.err;
  EXPECT_EQ(parsed.run(), ExitCode::promise_broken);
  EXPECT_TRUE(seen.flag);
  EXPECT_EQ(seen.text, "b");
  EXPECT_EQ(seen.word, "here");
  EXPECT_FALSE(seen.maybe_text);
  EXPECT_EQ(seen.kept, "");
  EXPECT_EQ(seen.texts, (std::vector<std::string>{"x", "y"}));
  EXPECT_EQ(seen.rest, (std::vector<std::string>{"r1", "r2"}));
  EXPECT_EQ(seen.count, 3u);
  EXPECT_FALSE(seen.maybe_count);
  EXPECT_EQ(seen.counts, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(seen.big, UINT64_MAX);
  EXPECT_EQ(seen.number, 1e-3);
  EXPECT_EQ(seen.maybe_number, 0);
}

TEST_F(Parsing, WhatDoesNotFitIsBadInput) {
  const std::vector<std::vector<std::string>> wrong = {{},
                                                       {"evry"},
                                                       {"every"},
                                                       {"every", "w", "--text", "c"},
                                                       {"every", "w", "--count", "4"},
                                                       {"every", "w", "--count", "-1"},
                                                       {"every", "w", "--counts", "1,x"},
                                                       {"every", "w", "--number", "0"},
                                                       {"every", "w", "--maybe-number", "-1"},
                                                       {"every", "w", "--big", "x"},
                                                       {"every", "w", "--text"}};
  for (const std::vector<std::string>& words : wrong) {
    const Parsed parsed = parse(words);
    EXPECT_EQ(parsed.code, ExitCode::bad_input) << words.size() << parsed.out;
    EXPECT_FALSE(parsed.run);
    EXPECT_FALSE(parsed.fault.empty());
  }
}

TEST_F(Parsing, AFlagAboveHoldsBelow) {
  commands.push_back(make_command<Everything>("every below", "below", declare, run));
  ASSERT_TRUE(parse({"every", "w", "--flag", "below", "v"}).run);
  EXPECT_EQ(parse({"every", "w", "--flag", "below", "v"}).run(), ExitCode::promise_broken);
  EXPECT_TRUE(seen.flag);
  EXPECT_EQ(seen.word, "v");
}

}  // namespace
}  // namespace metamer::cli
