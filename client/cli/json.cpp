#include "client/cli/json.h"

#include <google/protobuf/descriptor.h>

#include <string>

#include "client/tools/scene/words.h"
#include "common/digest.h"

namespace metamer::cli {
namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// Digests and the ids that are shorter; no others are for people.
Json bytes_json(const std::string& bytes) {
  if (bytes.empty() || bytes.size() > std::tuple_size_v<Digest>) return nullptr;
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += {digits[byte >> 4], digits[byte & 15]};
  }
  return text;
}

/// Singular, or element `i` of a repeated field.
Json value_json(const Message& message, const FieldDescriptor* field, int i) {
  const auto& reflect = *message.GetReflection();
  const bool repeated = field->is_repeated();
  switch (field->cpp_type()) {
    case FieldDescriptor::CPPTYPE_INT32:
      return repeated ? reflect.GetRepeatedInt32(message, field, i)
                      : reflect.GetInt32(message, field);
    case FieldDescriptor::CPPTYPE_INT64:
      return repeated ? reflect.GetRepeatedInt64(message, field, i)
                      : reflect.GetInt64(message, field);
    case FieldDescriptor::CPPTYPE_UINT32:
      return repeated ? reflect.GetRepeatedUInt32(message, field, i)
                      : reflect.GetUInt32(message, field);
    case FieldDescriptor::CPPTYPE_UINT64:
      return repeated ? reflect.GetRepeatedUInt64(message, field, i)
                      : reflect.GetUInt64(message, field);
    case FieldDescriptor::CPPTYPE_DOUBLE:
      return repeated ? reflect.GetRepeatedDouble(message, field, i)
                      : reflect.GetDouble(message, field);
    case FieldDescriptor::CPPTYPE_FLOAT:
      return repeated ? reflect.GetRepeatedFloat(message, field, i)
                      : reflect.GetFloat(message, field);
    case FieldDescriptor::CPPTYPE_BOOL:
      return repeated ? reflect.GetRepeatedBool(message, field, i)
                      : reflect.GetBool(message, field);
    case FieldDescriptor::CPPTYPE_ENUM:
      return client::word_of(repeated ? *reflect.GetRepeatedEnum(message, field, i)
                                      : *reflect.GetEnum(message, field));
    case FieldDescriptor::CPPTYPE_MESSAGE:
      return to_json(repeated ? reflect.GetRepeatedMessage(message, field, i)
                              : reflect.GetMessage(message, field));
    case FieldDescriptor::CPPTYPE_STRING: {
      const std::string text = repeated ? reflect.GetRepeatedString(message, field, i)
                                        : reflect.GetString(message, field);
      return field->type() == FieldDescriptor::TYPE_BYTES ? bytes_json(text) : Json(text);
    }
  }
  return nullptr;
}

bool is_pixels(const FieldDescriptor* field) {
  return field->type() == FieldDescriptor::TYPE_BYTES &&
         (field->name() == "xyz" || field->name() == "rgb" || field->name() == "factors");
}

}  // namespace

Json to_json(const Message& message) {
  const auto& reflect = *message.GetReflection();
  Json object = Json::object();
  for (int f = 0; f < message.GetDescriptor()->field_count(); ++f) {
    const FieldDescriptor* field = message.GetDescriptor()->field(f);
    if (is_pixels(field)) continue;
    if (field->is_repeated()) {
      Json& list = object[field->name()] = Json::array();
      for (int i = 0; i < reflect.FieldSize(message, field); ++i)
        list.push_back(value_json(message, field, i));
    } else if (!field->has_presence() || reflect.HasField(message, field)) {
      object[field->name()] = value_json(message, field, 0);
    }
  }
  return object;
}

Json to_json(const Problem& problem) {
  Json object = {{"field", problem.field},
                 {"file", problem.file},
                 {"line", problem.line},
                 {"column", problem.column},
                 {"message", problem.message}};
  if (!problem.was.empty()) object["was"] = problem.was;
  if (!problem.meant.empty()) object["meant"] = problem.meant;
  return object;
}

}  // namespace metamer::cli
