#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "client/cli/exit_code.h"

/// What a subcommand is, as data. parse.cpp alone knows the library that reads words.
namespace metamer::cli {

/// Where an option's value goes, and of what type it is.
using Target =
    std::variant<bool*, std::string*, std::optional<std::string>*, std::vector<std::string>*,
                 std::uint32_t*, std::optional<std::uint32_t>*, std::vector<std::uint32_t>*,
                 std::uint64_t*, std::vector<std::uint64_t>*, double*, std::optional<double>*>;

/// An option, a flag (of a bool), or a word that is known by its position.
struct Option {
  enum class Sign { any, not_negative, positive };

  std::string names;  ///< "--spp", "-o,--output"; "scene": by position.
  Target target;
  std::string meaning;          ///< A line of --help.
  std::string group = {};       ///< Its heading in --help; empty: the usual one.
  std::string type = {};        ///< What --help calls the value; empty: TEXT, UINT, …
  bool required = false;        ///< It has to be there.
  bool shows_default = false;   ///< --help tells the value that is there before.
  bool value_optional = false;  ///< A text that may be left out is empty then.
  bool single = false;          ///< A list, of which this command takes one.
  char separator = 0;           ///< Of a list in one word: ','.
  std::optional<std::pair<int, int>> range = {};
  Sign sign = Sign::any;
  std::vector<std::string> choices = {};  ///< Empty: whatever is said.
};

/// A subcommand: what is said of it in --help, its options, and what it does.
struct Command {
  std::string name;     ///< "check"; "spectra info" lies below "spectra", which comes before it.
  std::string meaning;  ///< A line of the help above it.
  std::vector<Option> options = {};
  std::function<ExitCode()> run = {};  ///< None: one of those below it has to be named.
  std::shared_ptr<void> values = {};   ///< What the options' targets belong to.
};

/// A subcommand whose options fill in `Values`. `run` does all that the word says, prints what
/// there is to print, and returns the program's exit code.
template <class Values>
Command make_command(std::string name, std::string meaning,
                     void (*declare)(Values&, std::vector<Option>&),
                     ExitCode (*run)(const Values&)) {
  const auto values = std::make_shared<Values>();
  Command command{.name = std::move(name), .meaning = std::move(meaning)};
  declare(*values, command.options);
  command.run = [run, values = values.get()] { return run(*values); };
  command.values = values;
  return command;
}

}  // namespace metamer::cli
