#pragma once

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <string>
#include <string_view>

#include "common/scene/text_positions.h"

namespace metamer {

/// The tokens of a text, as the text format's parser sees them. Errors are left to that parser.
class TextTokens {
 public:
  using Type = google::protobuf::io::Tokenizer::TokenType;

  /// `text`, of less than 2 GiB, outlives it.
  explicit TextTokens(std::string_view text)
      : stream_(text.data(), static_cast<int>(text.size())), tokenizer_(&stream_, &errors_) {
    tokenizer_.set_allow_f_after_float(true);
    tokenizer_.set_comment_style(google::protobuf::io::Tokenizer::SH_COMMENT_STYLE);
  }
  bool next() { return tokenizer_.Next(); }
  Type type() { return current().type; }
  bool is_identifier() { return type() == google::protobuf::io::Tokenizer::TYPE_IDENTIFIER; }
  bool is(std::string_view symbol) {
    return type() == google::protobuf::io::Tokenizer::TYPE_SYMBOL && current().text == symbol;
  }
  const std::string& text() { return current().text; }  ///< As it stands there, quotes and all.
  TextPosition position() { return {current().line, current().column}; }

 private:
  class IgnoreErrors : public google::protobuf::io::ErrorCollector {
   public:
    void AddError(int, int, const std::string&) override {}
  };
  const google::protobuf::io::Tokenizer::Token& current() { return tokenizer_.current(); }

  google::protobuf::io::ArrayInputStream stream_;
  IgnoreErrors errors_;
  google::protobuf::io::Tokenizer tokenizer_;
};

}  // namespace metamer
