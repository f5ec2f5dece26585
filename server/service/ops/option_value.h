#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "common/problem.h"
#include "server/service/ops/options.h"

namespace metamer::service {

/// A value as it is written, before it is known whether an option may have it.
using OptionValue = std::variant<bool, std::int64_t, double, std::string, std::vector<std::string>>;

/// Gives an option a value. Bytes may be a text: "8GiB". Errors, which say what was expected:
/// another type, out of the range, none of the words, what the option's own check says.
Result<void> set(const Option& option, Settings& settings, const OptionValue& value);

/// Gives `to` what `from` has.
void copy_value(const Option& option, const Settings& from, Settings& to);

/// A word of the command line as such a value; a list gets all words that were said.
Result<OptionValue> parse_words(const Option& option, const std::vector<std::string>& words);

/// The value as the file has it, "8GiB" in quotes, say; nothing where none is set.
std::optional<std::string> toml_text(const Option& option, const Settings& settings);

/// What may be there: "a number from 0 to 256", "seconds from 0.05 to 3600".
std::string expected_value(const Option& option);

/// For --help and the man pages: "SECONDS", "BYTES"; empty for a flag.
std::string value_name(const Option& option);
/// It may be said several times.
bool is_list(const Option& option);

}  // namespace metamer::service
