#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <vector>

/// What messages about the schema need from its descriptors.
namespace metamer {

std::vector<std::string> field_names(const google::protobuf::Descriptor& message);
std::vector<std::string> value_names(const google::protobuf::EnumDescriptor& type);

/// The enum of a field of that name in `message` or in what it holds; null when there is none.
const google::protobuf::EnumDescriptor* find_enum(const google::protobuf::Descriptor& message,
                                                  const std::string& field);

/// Whether a field of that name, in `message` or in what it holds, is a message of that type.
bool has_message(const google::protobuf::Descriptor& message, const std::string& field,
                 const std::string& type);

/// "a, b, c".
std::string join(const std::vector<std::string>& names);

}  // namespace metamer
