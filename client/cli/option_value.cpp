#include "client/cli/option_value.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <type_traits>

namespace metamer::cli {
namespace {

template <class T>
constexpr bool is_optional = false;
template <class T>
constexpr bool is_optional<std::optional<T>> = true;

Result<void> set_flag(bool& flag, const std::string& text) {
  if (text != "on" && text != "off") return problem(quoted(text) + " is neither on nor off");
  flag = text == "on";
  return {};
}

template <class Number>
Result<Number> number_of(const Option& option, const std::string& text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size())
    return problem(quoted(text) + (std::is_integral_v<Number> ? " is not a whole number from 0 on"
                                                              : " is not a number"));
  const auto value = static_cast<double>(number);
  if (std::isnan(value)) return problem(quoted(text) + " is not a number");
  if (option.range && (value < option.range->first || value > option.range->second))
    return problem(text + " is not from " + std::to_string(option.range->first) + " to " +
                   std::to_string(option.range->second));
  if (option.sign == Option::Sign::not_negative && value < 0) return problem(text + " is below 0");
  if (option.sign == Option::Sign::positive && !(value > 0))
    return problem(text + " is not above 0");
  return number;
}

template <class Value>
Result<void> set_typed(const Option& option, const std::string& text, Value& target) {
  if constexpr (std::is_same_v<Value, bool>) {
    return set_flag(target, text);
  } else if constexpr (is_optional<Value>) {
    typename Value::value_type value{};
    if (auto set = set_typed(option, text, value); !set) return set;
    target = std::move(value);
    return {};
  } else if constexpr (std::is_same_v<Value, std::string>) {
    const auto& choices = option.choices;
    if (!choices.empty() && std::find(choices.begin(), choices.end(), text) == choices.end())
      return tl::unexpected(unknown_name("there is no " + quoted(text), text, choices));
    target = text;
    return {};
  } else if constexpr (std::is_arithmetic_v<Value>) {
    return number_of<Value>(option, text).map([&](Value number) { target = number; });
  } else {
    typename Value::value_type value{};
    if (auto set = set_typed(option, text, value); !set) return set;
    target.push_back(std::move(value));
    return {};
  }
}

}  // namespace

Result<void> set_value(const Option& option, const std::string& text) {
  return std::visit([&](auto* target) { return set_typed(option, text, *target); }, option.target);
}

}  // namespace metamer::cli
