#include "client/tools/scene/text_fields.h"

#include <utility>

#include "common/scene/text_tokens.h"

namespace metamer::client {
namespace {

using google::protobuf::io::Tokenizer;

/// Stands at a token of a text, whose bytes it knows.
class FieldReader {
 public:
  explicit FieldReader(std::string_view text) : text_(text), tokens_(text) { next(); }

  std::vector<TextField> read() {
    std::vector<TextField> fields;
    while (more_) fields.push_back(read_field());
    return fields;
  }

 private:
  void next() {
    end_ = token_.end;
    more_ = tokens_.next() && tokens_.type() != Tokenizer::TYPE_END;
    if (!more_) return;
    token_.begin = byte_of(tokens_.position());
    token_.end = token_.begin + tokens_.text().size();
  }

  bool take(std::string_view symbol) {
    if (!more_ || !tokens_.is(symbol)) return false;
    next();
    return true;
  }

  TextField read_field() {
    TextField field;
    field.name = tokens_.text();
    field.span.begin = token_.begin;
    next();
    take(":");
    if (take("[")) {
      while (more_ && !tokens_.is("]")) {
        field.values.push_back(read_value());
        take(",");
      }
      take("]");
    } else {
      field.values.push_back(read_value());
    }
    field.span.end = end_;
    if (!take(",")) take(";");
    field.next = end_;
    return field;
  }

  TextSpan read_value() {
    const std::size_t begin = token_.begin;
    const auto type = tokens_.type();
    if (tokens_.is("{") || tokens_.is("<")) {
      skip_message();
    } else if (type == Tokenizer::TYPE_STRING) {
      // Strings that stand one after the other are one.
      while (more_ && tokens_.type() == Tokenizer::TYPE_STRING) next();
    } else {
      take("-");
      next();
    }
    return {begin, end_};
  }

  void skip_message() {
    int depth = 0;
    do {
      if (tokens_.is("{") || tokens_.is("<")) ++depth;
      if (tokens_.is("}") || tokens_.is(">")) --depth;
      next();
    } while (more_ && depth > 0);
  }

  /// Positions come in the text's order.
  std::size_t byte_of(TextPosition position) {
    constexpr int tab_width = 8;
    while (at_ < text_.size() && (seen_.line < position.line || seen_.column < position.column)) {
      const char c = text_[at_++];
      if (c == '\n')
        seen_ = {seen_.line + 1, 0};
      else
        seen_.column += c == '\t' ? tab_width - seen_.column % tab_width : 1;
    }
    return at_;
  }

  std::string_view text_;
  TextTokens tokens_;
  bool more_ = true;
  TextSpan token_;       ///< The one that this stands at.
  std::size_t end_ = 0;  ///< Of the one before it.
  std::size_t at_ = 0;   ///< The byte at seen_.
  TextPosition seen_;
};

}  // namespace

std::vector<TextField> text_fields(std::string_view text) { return FieldReader(text).read(); }

}  // namespace metamer::client
