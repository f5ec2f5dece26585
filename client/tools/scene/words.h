#pragma once

#include <google/protobuf/descriptor.h>

#include <string>
#include <vector>

#include "common/problem.h"
#include "metamer/v1/scene.pb.h"

/// The words that people write for the schema's enumerations: CIE_1931_2DEG is "cie-1931-2deg", or
/// that itself, as scene files have it.
/// Errors say which word names nothing, and which was perhaps meant.
namespace metamer::client {

std::string word_of(const google::protobuf::EnumValueDescriptor& value);
/// In the order of the enumeration.
std::vector<std::string> words_of(const google::protobuf::EnumDescriptor& type);

/// The value's number. `what` names the enumeration in the error, which lists all the words where
/// none is close.
Result<int> value_named(const std::string& word, const char* what,
                        const google::protobuf::EnumDescriptor& type);

Result<v1::Observer> observer_named(const std::string& word);
/// "none", "von-kries", "bradford", …
Result<v1::Adaptation> adaptation_named(const std::string& word);
Result<v1::RgbSpace> rgb_space_named(const std::string& word);

}  // namespace metamer::client
