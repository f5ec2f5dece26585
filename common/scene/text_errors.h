#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <string_view>

#include "common/scene/text_places.h"

namespace metamer {

/// An error of protobuf's text format parser in our words, at the place that is at fault.
struct TextError {
  TextPlace place;
  std::string message;
};

/// `message` at `place` as the parser gave them, `root` the message that `text` was read as.
TextError reword(std::string_view message, TextPlace place, std::string_view text,
                 const google::protobuf::Descriptor& root);

}  // namespace metamer
