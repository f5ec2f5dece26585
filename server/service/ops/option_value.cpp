#include "server/service/ops/option_value.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>

namespace metamer::service {

namespace {

template <class... Functions>
struct Cases : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Cases(Functions...) -> Cases<Functions...>;

/// Where the option's value lies in settings that are not changed.
OptionTarget target_of(const Option& option, const Settings& settings) {
  return option.at(const_cast<Settings&>(settings));
}

OptionTarget target_of(const Option& option) {
  static const Settings defaults;
  return target_of(option, defaults);
}

template <class Number>
std::optional<Number> parse_number(const std::string& text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// "8GiB", "300MB", "17": powers of 1,024.
std::optional<std::int64_t> parse_bytes(std::string text) {
  if (text.empty() || text[0] < '0' || text[0] > '9') return std::nullopt;
  try {
    if (!CLI::AsSizeValue(false)(text).empty()) return std::nullopt;
  } catch (const CLI::Error&) {
    return std::nullopt;
  }
  return parse_number<std::int64_t>(text);
}

std::string bytes_text(std::uint64_t bytes) {
  constexpr const char* units[] = {"B", "KiB", "MiB", "GiB", "TiB", "PiB"};
  std::size_t unit = 0;
  for (; bytes > 0 && bytes % 1024 == 0 && unit + 1 < std::size(units); ++unit) bytes /= 1024;
  return fmt::format("{}{}", bytes, units[unit]);
}

std::string limit_text(const Option& option, double limit) {
  return option.unit == Unit::bytes ? bytes_text(static_cast<std::uint64_t>(limit))
                                    : fmt::format("{}", limit);
}

/// What is written as a number, in the option's unit.
std::optional<double> number_of(const Option& option, const OptionValue& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return static_cast<double>(*whole);
  if (const auto* real = std::get_if<double>(&value); real && option.unit == Unit::seconds)
    return *real;
  if (const auto* text = std::get_if<std::string>(&value); text && option.unit == Unit::bytes)
    if (const auto bytes = parse_bytes(*text)) return static_cast<double>(*bytes);
  return std::nullopt;
}

/// A number that is in the option's range.
std::optional<double> allowed_number(const Option& option, const OptionValue& value) {
  const auto number = number_of(option, value);
  if (!number || !(*number >= option.min && *number <= option.max)) return std::nullopt;
  return number;
}

/// What is wrong with a text, whose type is right.
Result<void> check_text(const Option& option, const std::string& text) {
  const auto& words = option.words;
  if (!words.empty() && std::find(words.begin(), words.end(), text) == words.end())
    return problem("expected " + expected_value(option) + ", not " + quoted(text) +
                   did_you_mean(text, words));
  if (text.find('\0') != std::string::npos) return problem("a text has no zero bytes");
  return option.check ? option.check(text) : Result<void>{};
}

std::string toml_string(std::string_view text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      quoted += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
    else
      quoted += c;
  }
  return quoted + '"';
}

}  // namespace

std::string expected_value(const Option& option) {
  const std::string range =
      " from " + limit_text(option, option.min) + " to " + limit_text(option, option.max);
  const auto whole = [&] {
    return (option.unit == Unit::bytes ? "bytes" : "a whole number") + range;
  };
  const auto text = [&] {
    return option.words.empty() ? std::string("a text")
                                : fmt::format("one of {}", fmt::join(option.words, ", "));
  };
  return std::visit(
      Cases{[](bool*) { return std::string("true or false"); },
            [&](std::uint32_t*) { return whole(); }, [&](std::uint64_t*) { return whole(); },
            [&](std::optional<std::uint64_t>*) { return whole(); },
            [&](std::chrono::milliseconds*) { return "seconds" + range; },
            [&](std::string*) { return text(); }, [&](std::filesystem::path*) { return text(); },
            [](std::vector<std::string>*) { return std::string("a list of texts"); }},
      target_of(option));
}

std::string value_name(const Option& option) {
  if (option.unit == Unit::bytes) return "BYTES";
  if (option.unit == Unit::seconds) return "SECONDS";
  const OptionTarget target = target_of(option);
  if (std::holds_alternative<bool*>(target)) return "";
  const bool is_text = std::holds_alternative<std::string*>(target) ||
                       std::holds_alternative<std::filesystem::path*>(target) || is_list(option);
  if (!option.words.empty()) return fmt::format("{}", fmt::join(option.words, "|"));
  return is_text ? "TEXT" : "NUMBER";
}

bool is_list(const Option& option) {
  return std::holds_alternative<std::vector<std::string>*>(target_of(option));
}

Result<void> set(const Option& option, Settings& settings, const OptionValue& value) {
  const auto wrong = [&] { return problem("expected " + expected_value(option)); };
  const auto whole = [&](auto* target) -> Result<void> {
    const auto number = allowed_number(option, value);
    if (!number) return wrong();
    using Narrow = std::is_same<decltype(target), std::uint32_t*>;
    using Number = std::conditional_t<Narrow::value, std::uint32_t, std::uint64_t>;
    *target = static_cast<Number>(*number);
    return {};
  };
  const auto text = [&](auto* target) -> Result<void> {
    const auto* written = std::get_if<std::string>(&value);
    if (!written) return wrong();
    if (auto checked = check_text(option, *written); !checked) return checked;
    *target = *written;
    return {};
  };
  return std::visit(Cases{[&](bool* target) -> Result<void> {
                            const bool* written = std::get_if<bool>(&value);
                            if (!written) return wrong();
                            *target = *written;
                            return {};
                          },
                          [&](std::uint32_t* target) { return whole(target); },
                          [&](std::uint64_t* target) { return whole(target); },
                          [&](std::optional<std::uint64_t>* target) { return whole(target); },
                          [&](std::chrono::milliseconds* target) -> Result<void> {
                            const auto seconds = allowed_number(option, value);
                            if (!seconds) return wrong();
                            *target = std::chrono::milliseconds(std::llround(*seconds * 1000));
                            return {};
                          },
                          [&](std::string* target) { return text(target); },
                          [&](std::filesystem::path* target) { return text(target); },
                          [&](std::vector<std::string>* target) -> Result<void> {
                            const auto* written = std::get_if<std::vector<std::string>>(&value);
                            if (!written) return wrong();
                            for (const std::string& one : *written)
                              if (auto checked = check_text(option, one); !checked) return checked;
                            *target = *written;
                            return {};
                          }},
                    option.at(settings));
}

void copy_value(const Option& option, const Settings& from, Settings& to) {
  const OptionTarget source = target_of(option, from);
  std::visit([&](auto* target) { *target = *std::get<decltype(target)>(source); }, option.at(to));
}

Result<OptionValue> parse_words(const Option& option, const std::vector<std::string>& words) {
  if (is_list(option)) return words;
  const OptionTarget target = target_of(option);
  const std::string& word = words.back();
  if (std::holds_alternative<bool*>(target)) return OptionValue(word == "true");
  if (std::holds_alternative<std::string*>(target) ||
      std::holds_alternative<std::filesystem::path*>(target) || option.unit == Unit::bytes)
    return OptionValue(word);
  if (option.unit == Unit::seconds) {
    if (const auto seconds = parse_number<double>(word)) return OptionValue(*seconds);
  } else if (const auto whole = parse_number<std::int64_t>(word)) {
    return OptionValue(*whole);
  }
  return problem("expected " + expected_value(option) + ", not " + quoted(word));
}

std::optional<std::string> toml_text(const Option& option, const Settings& settings) {
  using Text = std::optional<std::string>;
  const auto whole = [&](std::uint64_t number) -> Text {
    return option.unit == Unit::bytes ? toml_string(bytes_text(number)) : std::to_string(number);
  };
  const auto text = [](const std::string& value) -> Text {
    return value.empty() ? Text() : toml_string(value);
  };
  return std::visit(Cases{[](const bool* value) -> Text { return *value ? "true" : "false"; },
                          [&](const std::uint32_t* value) { return whole(*value); },
                          [&](const std::uint64_t* value) { return whole(*value); },
                          [&](const std::optional<std::uint64_t>* value) {
                            return *value ? whole(**value) : Text();
                          },
                          [](const std::chrono::milliseconds* value) -> Text {
                            return fmt::format("{}", static_cast<double>(value->count()) / 1000);
                          },
                          [&](const std::string* value) { return text(*value); },
                          [&](const std::filesystem::path* value) { return text(value->string()); },
                          [](const std::vector<std::string>* value) -> Text {
                            if (value->empty()) return std::nullopt;
                            std::vector<std::string> quoted;
                            for (const std::string& one : *value)
                              quoted.push_back(toml_string(one));
                            return fmt::format("[{}]", fmt::join(quoted, ", "));
                          }},
                    target_of(option, settings));
}

}  // namespace metamer::service
