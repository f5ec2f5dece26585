#include "client/tools/scene/schema_path.h"

#include <cctype>
#include <map>
#include <utility>

#include "common/scene/scene_file.h"
#include "common/scene/schema.h"
#include "common/scene/text_tokens.h"

namespace metamer::client {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::io::Tokenizer;
using Kind = SchemaPath::Kind;

/// protobuf's parser nests no deeper.
constexpr std::size_t max_depth = 100;

bool is_message(const FieldDescriptor& field) { return field.message_type() != nullptr; }

/// What may come next inside the braces of a message.
enum class Expect { name, after_name, value, element };

/// A message whose braces are open.
struct Level {
  const Descriptor* message;
  std::string path;
  std::map<const FieldDescriptor*, std::size_t> given = {};  ///< How often each repeated one was.

  Expect expect = Expect::name;
  const FieldDescriptor* field = nullptr;  ///< The last one named; null: the schema has none.
  std::string word = {};                   ///< A value that may have been the next name.

  std::string path_of(const FieldDescriptor& of, std::size_t index) const {
    std::string result = path + (path.empty() ? "" : ".") + of.name();
    return of.is_repeated() ? result + "[" + std::to_string(index) + "]" : result;
  }
  /// Of the element of `field` that was begun last.
  std::string field_path() const {
    const auto count = given.find(field);
    return path_of(*field, count == given.end() ? 0 : count->second - 1);
  }
};

/// Follows the tokens of a text through the schema. Texts are unfinished: what does not fit is
/// passed over.
class Walk {
 public:
  explicit Walk(const Descriptor& root) { levels_.push_back({&root, {}}); }

  void take(TextTokens& token) {
    const std::string& text = token.text();
    const bool opens = token.is("{") || token.is("<"), closes = token.is("}") || token.is(">");
    if (unknown_ > 0) {
      unknown_ += opens || token.is("[") ? 1 : closes || token.is("]") ? -1 : 0;
      return;
    }
    if (opens) return open();
    if (closes) return close();
    if (token.is("[")) return open_list();
    Level& level = levels_.back();
    if (token.is("]") || token.is(",")) {
      level.word.clear();
      if (level.expect == Expect::element && token.is(",")) begin_element(level);
      if (level.expect != Expect::element || token.is("]")) level.expect = Expect::name;
    } else if (token.is(":")) {
      if (level.expect == Expect::name && !level.word.empty()) name(std::exchange(level.word, {}));
      if (level.expect == Expect::after_name) level.expect = Expect::value;
    } else if (token.is_identifier() && level.expect <= Expect::after_name) {
      name(text);
    } else if (level.expect == Expect::value && !token.is("-")) {
      level.expect = Expect::name;
      if (token.is_identifier()) level.word = text;
    }
  }

  const Level& level() const { return levels_.back(); }
  bool unknown() const { return unknown_ > 0; }

 private:
  void name(const std::string& text) {
    Level& level = levels_.back();
    level.word.clear();
    level.expect = Expect::after_name;
    level.field = level.message->FindFieldByName(text);
    if (level.field != nullptr) begin_element(level);
  }

  void begin_element(Level& level) {
    if (level.field != nullptr && level.field->is_repeated()) ++level.given[level.field];
  }

  void open() {
    Level& level = levels_.back();
    // The value before was a name, and the field before has no value.
    if (level.expect == Expect::name && !level.word.empty()) name(std::exchange(level.word, {}));
    const bool named = level.expect != Expect::name && level.field != nullptr;
    if (level.expect != Expect::element) level.expect = Expect::name;
    if (!named || !is_message(*level.field) || levels_.size() == max_depth) {
      ++unknown_;
      return;
    }
    levels_.push_back({level.field->message_type(), level.field_path()});
  }

  void close() {
    if (levels_.size() > 1)
      levels_.pop_back();
    else
      levels_.back().expect = Expect::name;
  }

  void open_list() {
    Level& level = levels_.back();
    const bool named = level.expect == Expect::after_name || level.expect == Expect::value;
    if (named && level.field != nullptr) {
      level.expect = Expect::element;
      return;
    }
    // An extension's name, or a list of what the schema does not have.
    level.expect = Expect::name;
    level.word.clear();
    ++unknown_;
  }

  std::vector<Level> levels_;
  long unknown_ = 0;  ///< Open braces and brackets inside something unknown.
};

/// Bytes of positions in a text, which are asked for in their order.
class Bytes {
 public:
  explicit Bytes(std::string_view text) : text_(text) {}

  std::size_t of(TextPosition position) {
    constexpr int tab_width = 8;
    for (; at_ < text_.size() && now_ < position; ++at_) {
      if (text_[at_] == '\n')
        now_ = {now_.line + 1, 0};
      else
        now_.column += text_[at_] == '\t' ? tab_width - now_.column % tab_width : 1;
    }
    return at_;
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  TextPosition now_;
};

/// Where the quotes of a string end, or its line; `begin` is after the opening quote.
std::size_t end_of_quoted(std::string_view text, std::size_t begin, char quote) {
  std::size_t at = begin;
  while (at < text.size() && text[at] != quote && text[at] != '\n')
    at += text[at] == '\\' && at + 1 < text.size() ? 2 : 1;
  return std::min(at, text.size());
}

std::size_t end_of_word(std::string_view text, std::size_t at) {
  while (at < text.size() &&
         (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_' || text[at] == '.'))
    ++at;
  return at;
}

/// Whether what follows the last token of a text, where there is none, ends in a comment.
bool ends_in_comment(std::string_view gap) {
  const std::size_t line = gap.rfind('\n');
  return gap.find('#', line == std::string_view::npos ? 0 : line) != std::string_view::npos;
}

void describe_text(const Level& level, SchemaPath& path) {
  path.field = level.field;
  if (path.field == nullptr || is_message(*path.field))
    path.kind = Kind::unknown;
  else
    path.path = level.field_path();
}

void describe_name(const Level& level, std::string_view word, SchemaPath& path) {
  path.kind = Kind::name;
  path.field = level.message->FindFieldByName(std::string(word));
  if (path.field == nullptr) return;
  const auto given = level.given.find(path.field);
  path.path = level.path_of(*path.field, given == level.given.end() ? 0 : given->second);
}

void describe_value(const Level& level, SchemaPath& path) {
  path.field = level.field;
  if (path.field == nullptr) return;
  path.path = level.field_path();
  if (is_message(*path.field))
    path.kind = Kind::brace;
  else
    path.kind = level.expect == Expect::after_name ? Kind::colon : Kind::value;
}

}  // namespace

SchemaPath schema_path(std::string_view text, std::size_t at, const Descriptor& root) {
  SchemaPath path;
  path.begin = path.end = at;
  if (text.size() > max_scene_text) return path;

  // Walk over the tokens before the byte, but not into the one that it touches.
  const std::string_view before = text.substr(0, at);
  Walk walk(root);
  TextTokens tokens(before);
  Bytes bytes(before);
  std::size_t end = 0;
  bool touches = false;
  while (!touches && tokens.next()) {
    const std::size_t begin = bytes.of(tokens.position());
    end = begin + tokens.text().size();
    if (tokens.type() == Tokenizer::TYPE_STRING && end == at) {
      const char quote = text[begin];
      const bool closed = end_of_quoted(before, begin + 1, quote) + 1 == at;
      touches = !closed;
      if (touches) {
        path.kind = Kind::text;
        path.begin = begin + 1;
        path.end = end_of_quoted(text, path.begin, quote);
      }
    } else if (tokens.type() != Tokenizer::TYPE_SYMBOL && end == at) {
      touches = true;
      path.begin = begin;
    }
    if (!touches) walk.take(tokens);
  }

  const Level& level = walk.level();
  path.message = level.message;
  path.path = level.path;
  if (!touches && ends_in_comment(before.substr(end))) {
    path.kind = Kind::comment;
    return path;
  }
  if (path.kind == Kind::text) {
    if (walk.unknown())
      path.kind = Kind::unknown;
    else
      describe_text(level, path);
    return path;
  }
  path.end = end_of_word(text, at);
  const std::string_view word = text.substr(path.begin, path.end - path.begin);
  // A word where a colon or a brace belongs is the next name; the field before has no value yet.
  if (walk.unknown())
    path.kind = Kind::unknown;
  else if (level.expect == Expect::name || (level.expect == Expect::after_name && !word.empty()))
    describe_name(level, word, path);
  else
    describe_value(level, path);
  return path;
}

std::vector<std::string> candidates(const SchemaPath& path) {
  if (path.kind == Kind::name && path.message != nullptr) return field_names(*path.message);
  if (path.kind != Kind::value || path.field == nullptr) return {};
  if (path.field->enum_type() != nullptr) return value_names(*path.field->enum_type());
  if (path.field->type() == FieldDescriptor::TYPE_BOOL) return {"true", "false"};
  return {};
}

}  // namespace metamer::client
