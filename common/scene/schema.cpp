#include "common/scene/schema.h"

namespace metamer {

using google::protobuf::Descriptor;
using google::protobuf::EnumDescriptor;
using google::protobuf::FieldDescriptor;

std::vector<std::string> field_names(const Descriptor& message) {
  std::vector<std::string> names;
  for (int i = 0; i < message.field_count(); ++i) names.push_back(message.field(i)->name());
  return names;
}

std::vector<std::string> value_names(const EnumDescriptor& type) {
  std::vector<std::string> names;
  for (int i = 0; i < type.value_count(); ++i) names.push_back(type.value(i)->name());
  return names;
}

// The schema of a scene is a tree: no message holds itself, so this ends.
const EnumDescriptor* find_enum(const Descriptor& message, const std::string& field) {
  for (int i = 0; i < message.field_count(); ++i) {
    const FieldDescriptor* member = message.field(i);
    if (member->enum_type() != nullptr && member->name() == field) return member->enum_type();
    if (member->message_type() == nullptr) continue;
    if (const auto* found = find_enum(*member->message_type(), field)) return found;
  }
  return nullptr;
}

bool has_message(const Descriptor& message, const std::string& field, const std::string& type) {
  for (int i = 0; i < message.field_count(); ++i) {
    const FieldDescriptor* member = message.field(i);
    const Descriptor* own = member->message_type();
    if (own == nullptr) continue;
    if (member->name() == field && own->name() == type) return true;
    if (has_message(*own, field, type)) return true;
  }
  return false;
}

std::string join(const std::vector<std::string>& names) {
  std::string result;
  for (const std::string& name : names) result += (result.empty() ? "" : ", ") + name;
  return result;
}

}  // namespace metamer
