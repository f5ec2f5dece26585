#include "client/tools/scene/schema_help.h"

#include <google/protobuf/descriptor.pb.h>

#include <algorithm>
#include <utility>

#include "client/tools/text/formatted.h"
#include "common/lights/registry.h"
#include "common/models/registry.h"
#include "metamer/v1/scene.pb.h"

namespace metamer::client {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::DescriptorPool;
using google::protobuf::EnumValueDescriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::OneofDescriptor;
using google::protobuf::SourceLocation;
using Table = std::map<std::string, std::string>;

/// Lines that proto/write_tables.cmake needs: "begin LIGHT_MEMBERS, written from …".
bool is_marker(std::string_view comment) {
  for (const std::string_view word : {"begin ", "end "}) {
    if (!comment.starts_with(word)) continue;
    const std::string_view name = comment.substr(word.size(), comment.find_first_of(" ,\n", 6));
    return name.size() > 1 && name.find_first_of("abcdefghijklmnopqrstuvwxyz") >= 2;
  }
  return false;
}

/// A comment's lines as one.
std::string flowing(const std::string& comment) {
  std::string text;
  for (const char c : comment) {
    const bool blank = c == ' ' || c == '\n' || c == '\t';
    if (!blank)
      text += c;
    else if (!text.empty() && text.back() != ' ')
      text += ' ';
  }
  while (text.ends_with(' ')) text.pop_back();
  return is_marker(text) ? std::string() : text;
}

template <class Described>
std::string comment_of(const Described* described) {
  SourceLocation location;
  if (described == nullptr || !described->GetSourceLocation(&location)) return {};
  std::string text = flowing(location.leading_comments);
  const std::string trailing = flowing(location.trailing_comments);
  if (!text.empty() && !trailing.empty()) text += ' ';
  return text + trailing;
}

std::string kind_of(const FieldDescriptor& field) {
  switch (field.cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
    case FieldDescriptor::CPPTYPE_INT64:
    case FieldDescriptor::CPPTYPE_UINT32:
    case FieldDescriptor::CPPTYPE_UINT64:
      return "whole number";
    case FieldDescriptor::CPPTYPE_DOUBLE:
    case FieldDescriptor::CPPTYPE_FLOAT:
      return "number";
    case FieldDescriptor::CPPTYPE_BOOL:
      return "true or false";
    case FieldDescriptor::CPPTYPE_STRING:
      return "text";
    case FieldDescriptor::CPPTYPE_ENUM: {
      std::string words;
      for (int i = 0; i < field.enum_type()->value_count(); ++i)
        words += (i > 0 ? " " : "") + field.enum_type()->value(i)->name();
      return "one of " + words;
    }
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return field.message_type()->name();
  }
  return {};
}

std::string range_text(const char* meaning, double low, double high, double usual,
                       const char* unit) {
  const std::string with_unit = *unit == '\0' ? "" : std::string(" ") + unit;
  return std::string(meaning) + "; " + number_text(low) + " to " + number_text(high) + with_unit +
         ", " + number_text(usual) + " when left out";
}

/// The line of models.def that a field of `message` is named by, and its parameters.
void add_models(models::Kind kind, const Descriptor& message, Table& table) {
  for (const models::Entry& entry : models::registry(kind)) {
    const FieldDescriptor* field = message.FindFieldByName(entry.name);
    if (field == nullptr || field->number() != entry.number) continue;
    table[field->full_name()] = std::string(entry.equation) + ". " + entry.citation;
    for (const models::Parameter& one : entry.parameters)
      if (const FieldDescriptor* own = field->message_type()->FindFieldByName(one.name))
        table[own->full_name()] =
            range_text(one.meaning, one.min, one.max, one.default_value, one.unit);
  }
}

void add_attenuations(Table& table) {
  for (const models::Entry& entry : models::registry(models::Kind::attenuation))
    if (const EnumValueDescriptor* value =
            v1::Material::Attenuation_descriptor()->FindValueByNumber(entry.number))
      table[value->full_name()] = std::string(entry.equation) + ". " + entry.citation;
}

void add_lights(Table& table) {
  for (const lights::Entry& entry : lights::registry()) {
    const FieldDescriptor* field = v1::Light::descriptor()->FindFieldByNumber(entry.number);
    if (field == nullptr) continue;
    const bool bare = field->message_type() == v1::Vec3::descriptor();
    if (!bare) table[field->full_name()] = std::string(entry.equation) + ". " + entry.citation;
    for (const lights::Parameter& one : entry.parameters) {
      const FieldDescriptor* own = bare ? field : field->message_type()->FindFieldByName(one.name);
      if (own == nullptr) continue;
      const bool vector = lights::value_count(one.kind) == 3;
      const char* unit = one.kind == lights::Parameter::Kind::angle ? "degrees" : one.unit;
      table[own->full_name()] =
          vector ? one.meaning
          : one.kind == lights::Parameter::Kind::length
              ? std::string(one.meaning) + ", m, above 0; " + number_text(one.default_value) +
                    " when left out"
              : range_text(one.meaning, one.min, one.max, one.default_value, unit);
    }
  }
}

Table tables() {
  Table table;
  add_models(models::Kind::model, *v1::Material::descriptor(), table);
  add_models(models::Kind::diffuse, *v1::Material::descriptor(), table);
  add_models(models::Kind::slope, *v1::Slope::descriptor(), table);
  add_attenuations(table);
  add_lights(table);
  return table;
}

}  // namespace

SchemaHelp::SchemaHelp(std::unique_ptr<DescriptorPool> pool)
    : pool_(std::move(pool)), tables_(tables()) {}
SchemaHelp::SchemaHelp(SchemaHelp&&) noexcept = default;
SchemaHelp& SchemaHelp::operator=(SchemaHelp&&) noexcept = default;
SchemaHelp::~SchemaHelp() = default;

Result<SchemaHelp> SchemaHelp::read(const std::string& descriptor_set) {
  google::protobuf::FileDescriptorSet files;
  if (!files.ParseFromString(descriptor_set)) return problem("it is no set of descriptors");
  auto pool = std::make_unique<DescriptorPool>();
  for (const auto& file : files.file())
    if (pool->BuildFile(file) == nullptr) return problem(file.name() + " can't be built");
  if (pool->FindMessageTypeByName(v1::Scene::descriptor()->full_name()) == nullptr)
    return problem("it has no scene");
  return SchemaHelp(std::move(pool));
}

std::string SchemaHelp::comment(const std::string& full_name) const {
  std::string text = comment_of(pool_->FindFieldByName(full_name));
  if (text.empty()) text = comment_of(pool_->FindMessageTypeByName(full_name));
  if (text.empty()) text = comment_of(pool_->FindEnumTypeByName(full_name));
  if (text.empty()) text = comment_of(pool_->FindEnumValueByName(full_name));
  const auto line = tables_.find(full_name);
  return text.empty() && line != tables_.end() ? line->second : text;
}

FieldHelp SchemaHelp::of(const FieldDescriptor& field) const {
  FieldHelp help;
  help.signature = field.name() + ": " + (field.is_repeated() ? "repeated " : "") + kind_of(field);
  std::string own = comment(field.full_name());
  const FieldDescriptor* described = pool_->FindFieldByName(field.full_name());
  if (own.empty() && described != nullptr) own = comment_of(described->real_containing_oneof());
  if (!own.empty()) help.paragraphs.push_back(std::move(own));
  std::string type;
  if (field.message_type() != nullptr) type = comment(field.message_type()->full_name());
  if (field.enum_type() != nullptr) type = comment(field.enum_type()->full_name());
  if (!type.empty()) help.paragraphs.push_back(std::move(type));
  if (help.paragraphs.empty())
    if (std::string parent = comment(field.containing_type()->full_name()); !parent.empty())
      help.paragraphs.push_back(field.containing_type()->name() + ": " + parent);
  return help;
}

FieldHelp SchemaHelp::of(const SchemaPath& path, std::string_view text) const {
  if (path.field == nullptr || path.kind == SchemaPath::Kind::comment ||
      path.kind == SchemaPath::Kind::unknown)
    return {};
  FieldHelp help = of(*path.field);
  if (path.kind != SchemaPath::Kind::value || path.field->enum_type() == nullptr) return help;
  const std::string word(text.substr(path.begin, path.end - path.begin));
  if (const EnumValueDescriptor* value = path.field->enum_type()->FindValueByName(word))
    if (std::string own = comment(value->full_name()); !own.empty())
      help.paragraphs.insert(help.paragraphs.begin(), word + ": " + own);
  return help;
}

}  // namespace metamer::client
