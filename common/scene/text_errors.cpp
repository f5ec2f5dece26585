#include "common/scene/text_errors.h"

#include <cctype>
#include <optional>
#include <vector>

#include "common/problem.h"
#include "common/scene/schema.h"
#include "common/scene/text_tokens.h"

namespace metamer {

namespace {

using google::protobuf::Descriptor;

/// What stands in `text` where `pattern` has a *; nothing where they differ.
std::optional<std::vector<std::string>> match(std::string_view text, std::string_view pattern) {
  std::vector<std::string> parts;
  while (true) {
    const std::size_t star = pattern.find('*');
    const std::string_view literal = pattern.substr(0, star);
    if (!text.starts_with(literal)) return std::nullopt;
    text.remove_prefix(literal.size());
    if (star == std::string_view::npos) {
      if (!text.empty()) return std::nullopt;
      return parts;
    }
    pattern.remove_prefix(star + 1);
    const std::size_t end =
        pattern.empty() ? text.size() : text.find(pattern.substr(0, pattern.find('*')));
    if (end == std::string_view::npos) return std::nullopt;
    parts.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
}

std::string found(const std::string& token) {
  return ", found " + (token.empty() ? "the end of the file" : quoted(token));
}

Problem no_such_field(const std::string& full_name, const std::string& name,
                      const Descriptor& root) {
  const Descriptor* type = root.file()->pool()->FindMessageTypeByName(full_name);
  if (type == nullptr)
    return unknown_name(quoted(full_name) + " has no field " + quoted(name), name, {});
  const std::vector<std::string> known = field_names(*type);
  Problem unknown = unknown_name(type->name() + " has no field " + quoted(name), name, known);
  if (unknown.meant.empty())
    unknown.message += known.empty() ? "; it has none" : "; its fields: " + join(known);
  return unknown;
}

Problem no_such_value(const std::string& field, const std::string& value, const Descriptor& root) {
  const auto* type = find_enum(root, field);
  const std::vector<std::string> known =
      type == nullptr ? std::vector<std::string>() : value_names(*type);
  return unknown_name(
      field + " has no value " + quoted(value) + " (its values: " + join(known) + ")", value,
      known);
}

/// What a spectrum could be that is written as a number or a file's name, at `position`; empty:
/// nothing of that kind stands there.
std::string meant_spectrum(std::string_view text, TextPosition position, const Descriptor& root) {
  using Tokenizer = google::protobuf::io::Tokenizer;
  TextTokens tokens(text);
  std::string field;
  while (tokens.next() && tokens.position() < position)
    if (tokens.is_identifier()) field = tokens.text();
  if (!(tokens.position() == position) || !has_message(root, field, "Spectrum")) return {};
  switch (tokens.type()) {
    case Tokenizer::TYPE_INTEGER:
    case Tokenizer::TYPE_FLOAT:
      return "{ constant: " + tokens.text() + " }";
    case Tokenizer::TYPE_STRING:
      return "{ file: " + tokens.text() + " }";
    default:
      return {};
  }
}

/// What is left: protobuf's sentence in the form of our own.
std::string plain(std::string message) {
  if (message.ends_with('.')) message.pop_back();
  if (!message.empty()) {
    message[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(message[0])));
  }
  return message;
}

}  // namespace

TextError reword(std::string_view message, TextPosition position, std::string_view text,
                 const Descriptor& root) {
  // Names are reported at the token after them; go back to the name.
  const auto at_name = [&](const std::string& name, std::string reworded) {
    return TextError{last_identifier(text, name, position).value_or(position), std::move(reworded)};
  };
  const auto unknown_at = [&](const std::string& name, Problem unknown) {
    TextError error = at_name(name, std::move(unknown.message));
    error.was = std::move(unknown.was);
    error.meant = std::move(unknown.meant);
    return error;
  };
  if (const auto m = match(message, "Message type \"*\" has no field named \"*\".")) {
    return unknown_at(m->at(1), no_such_field(m->at(0), m->at(1), root));
  }
  if (const auto m = match(message, "Unknown enumeration value of \"*\" for field \"*\".")) {
    return unknown_at(m->at(0), no_such_value(m->at(1), m->at(0), root));
  }
  if (const auto m = match(message, "Non-repeated field \"*\" is specified multiple times.")) {
    return at_name(m->at(0), m->at(0) + " is given twice");
  }
  if (const auto m = match(message,
                           "Field \"*\" is specified along with field \"*\", another member of "
                           "oneof \"*\".")) {
    return at_name(m->at(0), m->at(0) + " can't be given together with " + m->at(1));
  }

  // The rest are reported where they are.
  if (const auto m = match(message, "Expected identifier, got: *")) {
    return {position, "expected a field's name" + found(m->at(0))};
  }
  if (const auto m = match(message, "Expected integer, got: *")) {
    return {position, "expected a whole number" + found(m->at(0))};
  }
  if (const auto m = match(message, "Expected double, got: *")) {
    return {position, "expected a number" + found(m->at(0))};
  }
  if (const auto m = match(message, "Expect a decimal number, got: *")) {
    return {position, "expected a decimal number" + found(m->at(0))};
  }
  if (const auto m = match(message, "Expected string, got: *")) {
    return {position, "expected text in quotes" + found(m->at(0))};
  }
  if (const auto m = match(message, "Expected integer or identifier, got: *")) {
    return {position, "expected the name of a value" + found(m->at(0))};
  }
  if (const auto m = match(message, "Expected \"*\", found \"*\".")) {
    TextError error{position, "expected " + quoted(m->at(0)) + found(m->at(1))};
    error.meant = m->at(0) == "{" ? meant_spectrum(text, position, root) : "";
    if (error.meant.empty()) return error;
    error.was = m->at(1);
    error.message += "; a spectrum is meant: " + error.meant;
    return error;
  }
  if (const auto m = match(message, "Integer out of range (*)")) {
    return {position, m->at(0) + " is too large"};
  }
  return {position, plain(std::string(message))};
}

}  // namespace metamer
