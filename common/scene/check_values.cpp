#include <google/protobuf/descriptor.h>
#include <google/protobuf/unknown_field_set.h>

#include <algorithm>
#include <cmath>

#include "common/scene/findings.h"
#include "common/scene/limits.h"
#include "common/scene/schema.h"

namespace metamer {

namespace {

using google::protobuf::FieldDescriptor;
using google::protobuf::Message;

/// Walks a message and all that it holds. `path_` grows and shrinks on the way.
class Walk {
 public:
  Walk(std::string path, Findings& findings) : path_(std::move(path)), findings_(findings) {}

  void check(const Message& message) {
    check_fields_known(message, path_, findings_);
    std::vector<const FieldDescriptor*> fields;
    message.GetReflection()->ListFields(message, &fields);
    for (const FieldDescriptor* field : fields) {
      const std::size_t parent = path_.size();
      if (!path_.empty()) path_ += '.';
      path_ += field->name();
      check_field(message, *field);
      path_.resize(parent);
    }
  }

 private:
  void check_field(const Message& message, const FieldDescriptor& field) {
    if (!field.is_repeated()) {
      check_value(message, field, -1);
      return;
    }
    const int count = message.GetReflection()->FieldSize(message, &field);
    const std::size_t parent = path_.size();
    for (int i = 0; i < count; ++i) {
      path_ += '[' + std::to_string(i) + ']';
      check_value(message, field, i);
      path_.resize(parent);
    }
  }

  /// `index` is -1 where the field is not repeated.
  void check_value(const Message& message, const FieldDescriptor& field, int index) {
    const auto& get = *message.GetReflection();
    const bool repeated = index >= 0;
    switch (field.cpp_type()) {
      case FieldDescriptor::CPPTYPE_DOUBLE:
        check_number(repeated ? get.GetRepeatedDouble(message, &field, index)
                              : get.GetDouble(message, &field));
        break;
      case FieldDescriptor::CPPTYPE_STRING: {
        std::string scratch;
        check_text(repeated ? get.GetRepeatedStringReference(message, &field, index, &scratch)
                            : get.GetStringReference(message, &field, &scratch));
        break;
      }
      case FieldDescriptor::CPPTYPE_ENUM:
        check_enum(field, repeated ? get.GetRepeatedEnumValue(message, &field, index)
                                   : get.GetEnumValue(message, &field));
        break;
      case FieldDescriptor::CPPTYPE_MESSAGE:
        check(repeated ? get.GetRepeatedMessage(message, &field, index)
                       : get.GetMessage(message, &field));
        break;
      // Every value of these types is sound by itself.
      case FieldDescriptor::CPPTYPE_INT32:
      case FieldDescriptor::CPPTYPE_INT64:
      case FieldDescriptor::CPPTYPE_UINT32:
      case FieldDescriptor::CPPTYPE_UINT64:
      case FieldDescriptor::CPPTYPE_BOOL:
        break;
      case FieldDescriptor::CPPTYPE_FLOAT:
        check_number(repeated ? get.GetRepeatedFloat(message, &field, index)
                              : get.GetFloat(message, &field));
        break;
    }
  }

  void check_number(double value) {
    if (!std::isfinite(value)) {
      findings_.add(path_, name() + " must be finite (it is " + number_text(value) + ")");
    } else if (std::abs(value) > limits::max_coordinate && name() != "luminance") {
      // check_light allows more: a luminance is no place.
      check_range(value, -limits::max_coordinate, limits::max_coordinate, path_, findings_);
    }
  }

  void check_text(const std::string& text) {
    const auto is_control = [](char c) {
      return static_cast<unsigned char>(c) < 0x20 || c == '\x7F';
    };
    if (text.size() > limits::max_text) {
      findings_.add(path_, name() + " is too long (" + std::to_string(text.size()) +
                               " bytes; at most " + std::to_string(limits::max_text) + ")");
    } else if (!is_utf8(text)) {
      findings_.add(path_, name() + " must be UTF-8");
    } else if (std::any_of(text.begin(), text.end(), is_control)) {
      findings_.add(path_,
                    name() + " must not hold control characters (it is " + quoted(text) + ")");
    }
  }

  void check_enum(const FieldDescriptor& field, int value) {
    if (field.enum_type()->FindValueByNumber(value) != nullptr) return;
    findings_.add(path_, field.name() + " has no value " + std::to_string(value) +
                             " (its values: " + join(value_names(*field.enum_type())) + ")");
  }

  std::string name() const { return path_.substr(path_.rfind('.') + 1); }

  std::string path_;
  Findings& findings_;
};

}  // namespace

void check_fields_known(const Message& message, const std::string& field, Findings& findings) {
  const auto& unknown = message.GetReflection()->GetUnknownFields(message);
  if (unknown.empty()) return;
  findings.add(field, message.GetDescriptor()->name() +
                          " has a field that this version does not know (number " +
                          std::to_string(unknown.field(0).number()) + ")");
}

bool check_values(const Message& message, const std::string& field, Findings& findings) {
  const std::size_t before = findings.size();
  Walk(field, findings).check(message);
  return findings.size() == before;
}

}  // namespace metamer
