#pragma once

#include <google/protobuf/descriptor.h>

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "client/tools/scene/schema_path.h"
#include "common/problem.h"

namespace metamer::client {

/// What is to be said of a place in a scene's text.
struct FieldHelp {
  std::string signature;                ///< "luminance: number"
  std::vector<std::string> paragraphs;  ///< The first is the field's own, where it has one.
};

/// What the schema's own comments, and the tables of models and lights, say of its fields.
class SchemaHelp {
 public:
  /// From a google.protobuf.FileDescriptorSet as `protoc --include_source_info --include_imports`
  /// writes it. Error: it is none, or has no scene.
  static Result<SchemaHelp> read(const std::string& descriptor_set);
  SchemaHelp(SchemaHelp&&) noexcept;
  SchemaHelp& operator=(SchemaHelp&&) noexcept;
  ~SchemaHelp();

  /// Of a field: its own comment, else what its table says, else its oneof's comment; then that of
  /// its type; where there is none of these, that of the message which it is part of.
  FieldHelp of(const google::protobuf::FieldDescriptor& field) const;
  /// Of what lies around a byte of a text; empty: nothing is to be said. An enumeration's value
  /// that stands there comes first.
  FieldHelp of(const SchemaPath& path, std::string_view text) const;

  /// The comment of anything in the schema, by its full name: "metamer.v1.Light.luminance". Empty:
  /// it has none.
  std::string comment(const std::string& full_name) const;

 private:
  explicit SchemaHelp(std::unique_ptr<google::protobuf::DescriptorPool> pool);

  std::unique_ptr<google::protobuf::DescriptorPool> pool_;
  std::map<std::string, std::string> tables_;  ///< By full names.
};

}  // namespace metamer::client
