#include "client/cli/parse.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <sstream>
#include <type_traits>

#include "common/problem.h"

namespace metamer::cli {
namespace {

/// Under every --help.
const char* const footer =
    "Without --server (or METAMER_SERVER), render, turntable, sweep, check, bench and tradeoff "
    "start "
    "a\n"
    "private server and end it again; models, spectra, relight and compare need none; the other\n"
    "commands need one.\n"
    "\n"
    "Exit codes: 0 done, 2 bad input or usage, 3 no server, 4 job failed, 5 cancelled, 6 the\n"
    "picture is less accurate or slower than --tolerance or --deadline asked for, 1 otherwise\n"
    "(compare: over --max).";

template <class T>
constexpr bool is_list = false;
template <class T>
constexpr bool is_list<std::vector<T>> = true;

/// The option as CLI11 has it, by the type of its target.
CLI::Option* add(CLI::App& app, const Option& option) {
  const auto add_typed = [&](auto* target) -> CLI::Option* {
    using Value = std::remove_pointer_t<decltype(target)>;
    if constexpr (std::is_same_v<Value, bool>) {
      return app.add_flag(option.names, *target, option.meaning);
    } else if constexpr (std::is_same_v<Value, std::optional<std::string>>) {
      if (option.value_optional)
        return app
            .add_option_function<std::string>(
                option.names, [target](const std::string& text) { *target = text; }, option.meaning)
            ->expected(0, 1);
    }
    if constexpr (!std::is_same_v<Value, bool>) {
      CLI::Option* added = app.add_option(option.names, *target, option.meaning);
      // Each value is named by the option anew, so that what follows it may be another word.
      if (is_list<Value> && option.names[0] == '-' && option.separator == 0)
        added->allow_extra_args(false);
      return added;
    }
  };
  return std::visit(add_typed, option.target);
}

/// A number that is one: CLI11 takes "nan" for a number, and for none below 0.
std::string no_number(const std::string& text) {
  const bool nan = text.size() >= 3 && CLI::detail::to_lower(text).find("nan") != std::string::npos;
  return nan ? "Number " + text + " is not a number" : std::string();
}

/// The number, or why it is none. CLI11's own checks print the whole range of doubles.
std::string number_in(const std::string& text, double& value) {
  return CLI::detail::lexical_cast(text, value) ? std::string()
                                                : metamer::quoted(text) + " is not a number";
}

std::string not_negative(const std::string& text) {
  double value = 0;
  if (std::string wrong = number_in(text, value); !wrong.empty()) return wrong;
  return value < 0 ? text + " is below 0" : std::string();
}

std::string positive(const std::string& text) {
  double value = 0;
  if (std::string wrong = number_in(text, value); !wrong.empty()) return wrong;
  return value > 0 ? std::string() : text + " is not above 0";
}

void declare(CLI::App& app, const Option& option) {
  CLI::Option& added = *add(app, option);
  if (std::holds_alternative<double*>(option.target) ||
      std::holds_alternative<std::optional<double>*>(option.target))
    added.check(no_number);
  if (!option.group.empty()) added.group(option.group);
  if (!option.type.empty()) added.type_name(option.type);
  if (option.required) added.required();
  if (option.single) added.expected(1);
  if (option.separator != 0) added.delimiter(option.separator);
  if (option.range) added.check(CLI::Range(option.range->first, option.range->second));
  if (option.sign == Option::Sign::not_negative) added.check(not_negative);
  if (option.sign == Option::Sign::positive) added.check(positive);
  if (!option.choices.empty()) added.check(CLI::IsMember(option.choices));
  if (option.shows_default) added.capture_default_str();
}

/// A flag of a subcommand holds below it.
void inherit_flags(const Command& above, const Command& below) {
  for (const Option& given : above.options)
    for (const Option& option : below.options)
      if (option.names == given.names && std::holds_alternative<bool*>(given.target))
        *std::get<bool*>(option.target) |= *std::get<bool*>(given.target);
}

/// A command line's subcommands, and the one that was chosen.
class Parser {
 public:
  explicit Parser(const std::vector<Command>& commands) {
    app_.set_version_flag("--version", std::string("metamer ") + METAMER_VERSION);
    app_.require_subcommand(1);
    app_.footer(footer);
    for (const Command& command : commands) add(command);
  }

  Parsed parse(const std::string& program, std::vector<std::string> words) {
    app_.name(program);
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    Parsed parsed;
    try {
      app_.parse(std::move(words));
      parsed.run = chosen_;
    } catch (const CLI::ParseError& error) {
      std::ostringstream out, err;
      parsed.code = app_.exit(error, out, err) == 0 ? ExitCode::done : ExitCode::bad_input;
      if (error.get_exit_code() != 0) parsed.fault = error.what();
      parsed.out = out.str();
      parsed.err = err.str();
    }
    return parsed;
  }

 private:
  void add(const Command& command) {
    // Find what it lies below.
    const std::size_t space = command.name.rfind(' ');
    const bool top = space == std::string::npos;
    const Command* above = top ? nullptr : made_.at(command.name.substr(0, space)).first;
    CLI::App& parent = top ? app_ : *made_.at(above->name).second;
    CLI::App& app =
        *parent.add_subcommand(command.name.substr(top ? 0 : space + 1), command.meaning);
    made_[command.name] = {&command, &app};
    // One that does nothing by itself wants one of those below it; any other may have one.
    if (!command.run) app.require_subcommand(1);
    if (above != nullptr && above->run) parent.require_subcommand(0, 1);

    for (const Option& option : command.options) declare(app, option);
    // A parent's callback comes after its subcommand's.
    app.callback([this, &command, above, &app] {
      if (!app.get_subcommands().empty()) return;
      chosen_ = [&command, above] {
        if (above != nullptr) inherit_flags(*above, command);
        return command.run();
      };
    });
  }

  CLI::App app_{"Metamer renders scenes spectrally, on this machine or on a server."};
  std::map<std::string, std::pair<const Command*, CLI::App*>> made_;
  std::function<ExitCode()> chosen_;
};

}  // namespace

Parsed parse(const std::vector<Command>& commands, const std::string& program,
             const std::vector<std::string>& words) {
  return Parser(commands).parse(program, words);
}

}  // namespace metamer::cli
