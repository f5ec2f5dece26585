#include "common/scene/scene_file.h"

#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <google/protobuf/text_format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

#include "common/scene/files.h"
#include "common/scene/text_errors.h"
#include "common/scene/text_positions.h"

namespace metamer {

namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::TextFormat;
using Tree = TextFormat::ParseInfoTree;

// A scene nests six messages deep (object, transform, rotate, axis); twice that leaves room.
constexpr int max_depth = 12;

/// Keeps the first error: the parser stops there, and the tokenizer's later ones follow from it.
class FirstError : public google::protobuf::io::ErrorCollector {
 public:
  void AddError(int line, int column, const std::string& message) override {
    if (!first) first = TextError{{std::max(line, 0), std::max(column, 0)}, message};
  }
  void AddWarning(int, int, const std::string&) override {}

  std::optional<TextError> first;
};

/// A step of a field path: "light" and 2 for "light[2]".
struct Step {
  std::string_view name;
  std::optional<int> index;
};

/// Takes the first step off `path`; nothing when that is no path.
std::optional<Step> take_step(std::string_view& path) {
  std::string_view part = path.substr(0, path.find('.'));
  path.remove_prefix(std::min(path.size(), part.size() + 1));

  Step step{part.substr(0, part.find('[')), std::nullopt};
  part.remove_prefix(step.name.size());
  if (part.empty()) return step;
  if (part.size() < 3 || !part.ends_with(']')) return std::nullopt;
  int index = 0;
  const char* end = part.data() + part.size() - 1;
  const auto [stop, error] = std::from_chars(part.data() + 1, end, index);
  if (error != std::errc() || stop != end || index < 0) return std::nullopt;
  step.index = index;
  return step;
}

/// Whether two texts are of the same number.
bool is_number(std::string_view one, std::string_view other) {
  double values[2] = {};
  std::size_t i = 0;
  for (const std::string_view text : {one, other})
    if (std::from_chars(text.data(), text.data() + text.size(), values[i++]).ec != std::errc())
      return false;
  return values[0] == values[1];
}

std::optional<TextPosition> position_of(const Tree& tree, const FieldDescriptor& field, int index) {
  const auto location = tree.GetLocation(&field, index);
  if (location.line < 0) return std::nullopt;
  return TextPosition{location.line, location.column};
}

}  // namespace

struct SceneFile::State {
  v1::Scene scene;
  std::string text;
  std::string file;
  TextLines lines{{}};
  TextLists lists;
  Tree tree;

  std::optional<TextPosition> locate(std::string_view path) const;
  std::optional<TextPosition> element(const Tree& tree, const FieldDescriptor& field,
                                      int index) const;
};

/// Where element `index` of a repeated field stands.
std::optional<TextPosition> SceneFile::State::element(const Tree& parent,
                                                      const FieldDescriptor& field,
                                                      int index) const {
  if (!lists.names.contains(field.name())) return position_of(parent, field, index);

  // Count through the field's appearances, each a single value or a list.
  std::size_t left = static_cast<std::size_t>(index);
  for (int i = 0;; ++i) {
    const auto position = position_of(parent, field, i);
    if (!position) return std::nullopt;
    const auto list = lists.elements.find(*position);
    const bool single = list == lists.elements.end();
    const std::size_t count = single ? 1 : list->second.size();
    if (left < count) return single ? *position : list->second[left];
    left -= count;
  }
}

std::optional<TextPosition> SceneFile::State::locate(std::string_view path) const {
  std::optional<TextPosition> nearest;
  const Tree* parent = &tree;
  const Descriptor* type = v1::Scene::descriptor();
  while (!path.empty() && parent != nullptr && type != nullptr) {
    // Find the step's field.
    const auto step = take_step(path);
    if (!step) break;
    const FieldDescriptor* field = type->FindFieldByName(std::string(step->name));
    if (field == nullptr) break;
    if (!field->is_repeated() && step->index) break;

    // A repeated field without an index means all of it: it stands where its first one does.
    const int index = field->is_repeated() ? step->index.value_or(0) : -1;
    const auto position = field->is_repeated() ? element(*parent, *field, index)
                                               : position_of(*parent, *field, index);
    if (!position) break;
    nearest = position;

    // Go into it.
    type = field->message_type();
    parent = type == nullptr ? nullptr : parent->GetTreeForNested(field, index);
  }
  return nearest;
}

SceneFile::SceneFile(std::unique_ptr<State> state) : state_(std::move(state)) {}
SceneFile::SceneFile(SceneFile&&) noexcept = default;
SceneFile& SceneFile::operator=(SceneFile&&) noexcept = default;
SceneFile::~SceneFile() = default;

Result<SceneFile> SceneFile::parse(std::string text, std::string file) {
  if (text.size() > max_scene_text)
    return tl::unexpected(
        Problem{.field = {},
                .file = std::move(file),
                .message = "file is too large " + size_and_limit(text.size(), max_scene_text)});
  auto state = std::make_unique<State>();
  state->text = std::move(text);
  state->file = std::move(file);
  state->lines = TextLines(state->text);

  // Parse, and remember where each field stands.
  FirstError errors;
  TextFormat::Parser parser;
  parser.RecordErrorsTo(&errors);
  parser.WriteLocationsTo(&state->tree);
  parser.SetRecursionLimit(max_depth);
  google::protobuf::io::ArrayInputStream stream(state->text.data(),
                                                static_cast<int>(state->text.size()));
  if (!parser.Parse(&stream, &state->scene)) {
    const TextError raw = errors.first.value_or(TextError{{}, "the text can't be read"});
    const TextError error =
        reword(raw.message, raw.position, state->text, *v1::Scene::descriptor());
    return tl::unexpected(Problem{.field = {},
                                  .file = state->file,
                                  .line = error.position.line + 1,
                                  .column = state->lines.column(state->text, error.position),
                                  .message = error.message,
                                  .was = error.was,
                                  .meant = error.meant});
  }
  state->lists = find_lists(state->text);
  return SceneFile(std::move(state));
}

Result<SceneFile> SceneFile::read(const std::filesystem::path& file) {
  auto text = read_file(file, max_scene_text);
  if (!text) return tl::unexpected(std::move(text.error()));
  return parse(*std::move(text), file.string());
}

const v1::Scene& SceneFile::scene() const { return state_->scene; }
v1::Scene& SceneFile::scene() { return state_->scene; }
const std::string& SceneFile::text() const { return state_->text; }
const std::string& SceneFile::file() const { return state_->file; }

Problem SceneFile::locate(Problem problem) const {
  if (!problem.file.empty()) return problem;
  problem.file = state_->file;
  if (const auto position = state_->locate(problem.field)) {
    problem.line = position->line + 1;
    problem.column = state_->lines.column(state_->text, *position);
    // A number as it is written there: 1e3, not 1000.
    const std::string_view written = number_at(state_->text, state_->lines.begin(*position),
                                               static_cast<std::size_t>(problem.column));
    if (!written.empty() && is_number(problem.was, written)) problem.was = written;
  }
  return problem;
}

}  // namespace metamer
