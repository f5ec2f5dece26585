#include "common/spectral/files/tokens.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace metamer::spectrum_text {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

}  // namespace

Tokens::Tokens(std::string_view text) : text_(text) {
  // Editors on Windows mark UTF-8 with these bytes.
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
  advance();
}

std::optional<Token> Tokens::next() {
  const std::optional<Token> token = ahead_;
  advance();
  return token;
}

Token Tokens::end() const {
  return {.text = {},
          .line = line_,
          .column = static_cast<int>(position_ - line_begin_) + 1,
          .unclosed = false};
}

void Tokens::skip_to_word() {
  while (position_ < text_.size()) {
    const char c = text_[position_];
    if (c == '\n') {
      line_begin_ = ++position_;
      ++line_;
    } else if (is_space(c)) {
      ++position_;
    } else if (c == '#') {
      position_ = std::min(text_.find('\n', position_), text_.size());
    } else {
      return;
    }
  }
}

void Tokens::advance() {
  skip_to_word();
  ahead_.reset();
  if (position_ == text_.size()) return;
  Token token = end();

  // Take a string up to its quote, else a word up to white space.
  std::size_t begin = position_;
  std::size_t end = begin;
  const bool is_string = text_[begin] == '"';
  if (is_string) {
    begin = end = begin + 1;
    while (end < text_.size() && text_[end] != '"' && text_[end] != '\n') ++end;
    token.unclosed = end == text_.size() || text_[end] == '\n';
  } else {
    while (end < text_.size() && text_[end] != '\n' && !is_space(text_[end])) ++end;
  }
  token.text = text_.substr(begin, end - begin);
  position_ = is_string && !token.unclosed ? end + 1 : end;
  ahead_ = token;
}

tl::unexpected<Problem> problem_at(const std::string& file, const Token& token,
                                   std::string message) {
  return tl::unexpected<Problem>({.field = {},
                                  .file = file,
                                  .line = token.line,
                                  .column = token.column,
                                  .message = std::move(message)});
}

Result<double> parse_number(const std::string& file, const Token& token) {
  std::string_view text = token.text;
  // from_chars takes no plus sign, but must not see the minus of "+-1".
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) {
    return problem_at(file, token, quoted(token.text) + " is not a number");
  }
  if (error != std::errc() || !std::isfinite(value)) {
    return problem_at(file, token, quoted(token.text) + " is not a finite number");
  }
  return value;
}

}  // namespace metamer::spectrum_text
