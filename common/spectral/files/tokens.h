#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/problem.h"

/// The words of a spectrum file, each with its place. Used by the readers in this folder only.
namespace metamer::spectrum_text {

struct Token {
  std::string_view text;  ///< Without quotes.
  int line = 0;           ///< From 1.
  int column = 0;         ///< From 1, in bytes.
  bool unclosed = false;  ///< A string whose line ends before its closing quote.
};

/// Splits text at white space. "…" is one word, also with white space in it; `#` at the beginning
/// of a word makes the rest of its line a comment. Nothing is copied: `text` must outlive it.
class Tokens {
 public:
  explicit Tokens(std::string_view text);

  /// The word that next() will give; nothing at the end.
  const std::optional<Token>& peek() const { return ahead_; }
  std::optional<Token> next();

  /// Where the text ends: the place of what is missing there.
  Token end() const;

 private:
  void advance();
  void skip_to_word();

  std::string_view text_;
  std::size_t position_ = 0;
  std::size_t line_begin_ = 0;
  int line_ = 1;
  std::optional<Token> ahead_;
};

/// `message` at the place of `token`.
tl::unexpected<Problem> problem_at(const std::string& file, const Token& token,
                                   std::string message);

/// A finite decimal number, whatever the locale. Errors: another word, NaN, infinity, overflow.
Result<double> parse_number(const std::string& file, const Token& token);

}  // namespace metamer::spectrum_text
