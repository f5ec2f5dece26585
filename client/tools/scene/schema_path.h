#pragma once

#include <google/protobuf/descriptor.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Which field of the schema a byte of a text scene lies in, though the text is not finished or not
/// right: for completion and help in an editor.
namespace metamer::client {

struct SchemaPath {
  enum class Kind {
    name,     ///< A field's name stands here or could: one of `message`.
    colon,    ///< After the name of `field`, which is a scalar: ":" is to come.
    brace,    ///< Before the value of `field`, which is a message: "{" is to come, or "[".
    value,    ///< A value of `field`, without quotes.
    text,     ///< Inside the quotes of a value of `field`.
    comment,  ///< Nothing is to be said.
    unknown,  ///< Inside something that the schema does not have.
  };
  Kind kind = Kind::unknown;
  /// Of `field`, or of `message` where there is no field; elements of a list are counted from 0:
  /// "light[1].spectrum". Empty: the root.
  std::string path = {};
  const google::protobuf::Descriptor* message = nullptr;  ///< That the byte lies in.
  /// At a name: the field that the whole word names; null: none.
  const google::protobuf::FieldDescriptor* field = nullptr;
  /// The word that the byte lies in or touches; in quotes, all between them on this line. Bytes of
  /// the text, begin <= at <= end.
  std::size_t begin = 0, end = 0;
};

/// Of byte `at` of a text in protobuf's format, whose root is `root`: what lies between the bytes
/// at - 1 and at, 0 <= at <= text.size(). What comes after it counts only as the rest of its word.
/// Takes time by the length of the text and memory by the depth of the schema. A text over
/// max_scene_text has no paths (unknown).
SchemaPath schema_path(std::string_view text, std::size_t at,
                       const google::protobuf::Descriptor& root);

/// What can stand there: the message's fields, an enumeration's values, true and false. Empty:
/// nothing that can be listed.
std::vector<std::string> candidates(const SchemaPath& path);

}  // namespace metamer::client
