#include "client/tools/scene/look_edit.h"

#include <google/protobuf/text_format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "client/tools/scene/look_change.h"
#include "client/tools/scene/text_fields.h"
#include "common/scene/scene_file.h"

namespace metamer::client {
namespace {

using google::protobuf::FieldDescriptor;

/// As a scene file has it, on one line.
std::string line_of(const google::protobuf::Message& message) {
  google::protobuf::TextFormat::Printer printer;
  printer.SetSingleLineMode(true);
  printer.SetUseUtf8StringEscaping(true);
  printer.SetUseShortRepeatedPrimitives(true);
  std::string text;
  printer.PrintToString(message, &text);
  while (text.ends_with(' ')) text.pop_back();
  return text;
}

/// "spp: 4"; empty: it is not set.
std::string field_line(v1::Settings settings, const FieldDescriptor& field) {
  const auto& type = *v1::Settings::descriptor();
  for (int i = 0; i < type.field_count(); ++i)
    if (type.field(i) != &field) settings.GetReflection()->ClearField(&settings, type.field(i));
  return line_of(settings);
}

using FieldLine = std::pair<const FieldDescriptor*, std::string>;

/// The fields in which they differ, as they are in `wanted`.
std::vector<FieldLine> differing(const v1::Settings& now, const v1::Settings& wanted) {
  std::vector<FieldLine> lines;
  const auto& type = *v1::Settings::descriptor();
  bool choice = false;
  for (int i = 0; i < type.field_count(); ++i) {
    std::string line = field_line(wanted, *type.field(i));
    if (line == field_line(now, *type.field(i))) continue;
    const int number = type.field(i)->number();
    const bool chooses =
        number == v1::Settings::kMethodFieldNumber || number == v1::Settings::kGoalFieldNumber;
    choice = choice || chooses;
    if (!chooses) lines.emplace_back(type.field(i), std::move(line));
  }
  // An older text has its goal in its method: both are written anew.
  if (choice)
    for (const int number : {v1::Settings::kMethodFieldNumber, v1::Settings::kGoalFieldNumber})
      lines.emplace_back(type.FindFieldByNumber(number),
                         field_line(wanted, *type.FindFieldByNumber(number)));
  return lines;
}

/// A text with the edits that are made to it, in any order.
class SceneEdits {
 public:
  explicit SceneEdits(std::string_view text) : text_(text), fields_(text_fields(text)) {}

  void write_look(const v1::Look& look, int index) {
    for (const TextField& field : fields_) {
      if (field.name != "look") continue;
      const int count = static_cast<int>(field.values.size());
      if (index < count) {
        const TextSpan& place = field.values[static_cast<std::size_t>(index)];
        edits_.push_back({place.begin, place.end, "{ " + line_of(look) + " }"});
        return;
      }
      index -= count;
    }
    append("look { " + line_of(look) + " }");
  }

  void write_settings(const std::vector<FieldLine>& lines) {
    const auto own = std::find_if(fields_.begin(), fields_.end(),
                                  [](const TextField& one) { return one.name == "settings"; });
    std::string added;
    if (own != fields_.end()) {
      const TextSpan inside{own->values[0].begin + 1, own->values[0].end - 1};
      const auto there = text_fields(text_.substr(inside.begin, inside.end - inside.begin));
      for (const auto& [field, line] : lines)
        if (!replace_field(there, inside.begin, field->name(), line) && !line.empty())
          added += line + ' ';
      if (!added.empty()) insert_before_brace(inside.end, added);
      return;
    }
    for (const auto& [field, line] : lines)
      if (!line.empty()) added += line + ' ';
    if (!added.empty()) append("settings { " + added + "}");
  }

  /// All as one.
  TextEdit take() {
    if (!appended_.empty()) edits_.push_back({text_.size(), text_.size(), std::move(appended_)});
    std::stable_sort(edits_.begin(), edits_.end(),
                     [](const TextEdit& a, const TextEdit& b) { return a.begin < b.begin; });
    TextEdit whole = edits_.front();
    for (std::size_t i = 1; i < edits_.size(); ++i) {
      whole.text += text_.substr(whole.end, edits_[i].begin - whole.end);
      whole.text += edits_[i].text;
      whole.end = edits_[i].end;
    }
    return whole;
  }

 private:
  void append(const std::string& line) {
    if (appended_.empty() && !text_.empty() && !text_.ends_with('\n')) appended_ = "\n";
    appended_ += line + "\n";
  }

  bool replace_field(const std::vector<TextField>& there, std::size_t offset,
                     const std::string& name, const std::string& line) {
    for (const TextField& field : there) {
      if (field.name != name) continue;
      const std::size_t end = line.empty() ? field.next : field.span.end;
      edits_.push_back({offset + field.span.begin, offset + end, line});
      return true;
    }
    return false;
  }

  /// On a line of its own where the brace is.
  void insert_before_brace(std::size_t brace, const std::string& fields) {
    const std::size_t newline = text_.rfind('\n', brace);
    const std::size_t begin = newline == std::string_view::npos ? 0 : newline + 1;
    const std::string_view before = text_.substr(begin, brace - begin);
    if (newline != std::string_view::npos &&
        before.find_first_not_of(" \t") == std::string_view::npos)
      edits_.push_back({begin, begin, std::string(before) + "  " + fields + "\n"});
    else
      edits_.push_back({brace, brace, (before.ends_with(' ') ? "" : " ") + fields});
  }

  std::string_view text_;
  std::vector<TextField> fields_;
  std::vector<TextEdit> edits_;
  std::string appended_;
};

/// The settings of a scene under a look.
Result<v1::Settings> settings_under(const Look& look, v1::Scene scene) {
  if (const auto done = apply(look, scene); !done) return tl::unexpected(done.error());
  return scene.settings();
}

}  // namespace

Result<TextEdit> look_edit(std::string_view text, const Look& look, const std::string& name,
                           const SceneLooks& standard) {
  const auto parsed = SceneFile::parse(std::string(text), {});
  if (!parsed) return tl::unexpected(parsed.error());
  v1::Scene own = without_objects(parsed->scene());
  const v1::Look message = to_message(look, name);

  // What the look can't say is what is missing once it is applied.
  v1::Scene named;
  *named.add_look() = message;
  const auto wanted = settings_under(look, own);
  if (!wanted) return tl::unexpected(wanted.error());
  const auto said = settings_under(*look_named(named, name), own);
  if (!said) return tl::unexpected(said.error());

  SceneEdits edits(text);
  SceneLooks looks = own.look_size() == 0 ? standard : own.look();
  const bool none = own.look_size() == 0;
  const auto place =
      std::find_if(looks.begin(), looks.end(), [&](const auto& one) { return one.name() == name; });
  const int index = static_cast<int>(place - looks.begin());
  if (place == looks.end()) looks.Add();
  looks[index] = message;
  for (int i = 0; i < looks.size(); ++i)
    if (none || i == index) edits.write_look(looks[i], i);
  edits.write_settings(differing(*said, *wanted));
  return edits.take();
}

}  // namespace metamer::client
