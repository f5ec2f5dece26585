#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>

#include "common/scene/text_positions.h"

namespace metamer {

/// An error of protobuf's text format parser in our words, at the position that is at fault.
struct TextError {
  TextPosition position;
  std::string message;
  std::string was{}, meant{};  ///< As a Problem's.
};

/// `message` at `position` as the parser gave them, `root` the message that `text` was read as.
TextError reword(std::string_view message, TextPosition position, std::string_view text,
                 const google::protobuf::Descriptor& root);

}  // namespace metamer
