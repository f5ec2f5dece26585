#include "client/tools/scene/problem_fix.h"

#include <google/protobuf/io/tokenizer.h>

#include <algorithm>

#include "common/scene/text_tokens.h"

namespace metamer::client {
namespace {

using google::protobuf::io::Tokenizer;

/// A field's name, ":", "[", "-" and a value stand before what comes next.
constexpr int most_tokens = 5;

/// Where line and column, from 1, in bytes, lie; the text's end if it has no such line.
std::size_t byte_of(std::string_view text, int line, int column) {
  std::size_t at = 0;
  for (int i = 1; i < line; ++i) {
    const std::size_t end = text.find('\n', at);
    if (end == std::string_view::npos) return text.size();
    at = end + 1;
  }
  return std::min(text.size(), at + static_cast<std::size_t>(std::max(0, column - 1)));
}

std::string in_quotes(std::string_view text, char quote) {
  std::string result(1, quote);
  for (const char c : text) {
    if (c == quote || c == '\\') result += '\\';
    result += c;
  }
  return result + quote;
}

/// Bytes of the token after `at`, which is where the one before it ended.
std::size_t begin_of(std::string_view text, std::size_t at, const std::string& token) {
  while (at < text.size() && text.substr(at, token.size()) != token) {
    // The token may stand in a comment before itself.
    const bool comment = text[at] == '#';
    at = comment ? std::min(text.find('\n', at), text.size()) : at + 1;
  }
  return at;
}

}  // namespace

std::optional<TextEdit> replacement(std::string_view text, const Problem& problem,
                                    std::string_view by) {
  if (problem.line <= 0 || problem.was.empty()) return std::nullopt;
  std::size_t at = byte_of(text, problem.line, problem.column);
  const bool negative = problem.was.starts_with('-');
  const std::string_view was = std::string_view(problem.was).substr(negative ? 1 : 0);
  // The tokenizer takes lengths below 2 GiB; what is looked for is near.
  constexpr std::size_t near = 1u << 16;
  TextTokens tokens(text.substr(at, near));
  std::size_t minus = text.size();
  for (int i = 0; i < most_tokens && tokens.next(); ++i) {
    const std::string& token = tokens.text();
    const std::size_t begin = begin_of(text, at, token);
    at = begin + token.size();
    if (tokens.type() == Tokenizer::TYPE_STRING) {
      std::string value;
      Tokenizer::ParseString(token, &value);
      if (value == problem.was) return TextEdit{begin, at, in_quotes(by, token.front())};
    } else if (token == was && (minus < text.size()) == negative) {
      return TextEdit{std::min(begin, minus), at, std::string(by)};
    }
    minus = tokens.is("-") ? begin : text.size();
  }
  return std::nullopt;
}

std::optional<TextEdit> problem_fix(std::string_view text, const Problem& problem) {
  if (problem.meant.empty()) return std::nullopt;
  return replacement(text, problem, problem.meant);
}

}  // namespace metamer::client
